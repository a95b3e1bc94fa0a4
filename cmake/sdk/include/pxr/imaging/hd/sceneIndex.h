#ifndef PXR_IMAGING_HD_SCENE_INDEX_H
#define PXR_IMAGING_HD_SCENE_INDEX_H

/// \file
/// The scene as Hydra 2 sees it, declared only as far as handing it on needs.

#include "pxr/base/tf/refBase.h"
#include "pxr/base/tf/refPtr.h"
#include "pxr/base/tf/weakBase.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Never made or derived from here: its virtual functions are not declared.
class HdSceneIndexBase : public TfRefBase, public TfWeakBase {
  public:
    HD_API ~HdSceneIndexBase() override;

  private:
    HdSceneIndexBase() = delete;
};

using HdSceneIndexBaseRefPtr = TfRefPtr<HdSceneIndexBase>;

PXR_NAMESPACE_CLOSE_SCOPE

#endif
