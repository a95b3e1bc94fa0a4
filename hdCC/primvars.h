#ifndef HDCC_PRIMVARS_H
#define HDCC_PRIMVARS_H

#include <initializer_list>
#include <string>

#include "core/scene/primvar.h"

#include "pxr/base/tf/token.h"
#include "pxr/imaging/hd/enums.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdSceneDelegate;

/// Reads a primvar of a prim or an instancer, without the prefix primvars:, if it has one of these
/// interpolations. Returns false, and leaves the rest alone, if there is none.
/// @param primvar  empty if there are no values, or none that can be used
/// @param error    set if the values have a type that cannot be used
bool HdCCGetPrimvar(HdSceneDelegate *delegate, SdfPath const &id, TfToken const &name,
                    std::initializer_list<HdInterpolation> interpolations, cc::Primvar *primvar,
                    std::string *error);

PXR_NAMESPACE_CLOSE_SCOPE

#endif
