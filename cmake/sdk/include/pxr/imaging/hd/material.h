#ifndef PXR_IMAGING_HD_MATERIAL_H
#define PXR_IMAGING_HD_MATERIAL_H

#include "pxr/base/tf/token.h"
#include "pxr/base/vt/dictionary.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/sprim.h"
#include "pxr/imaging/hd/types.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

#include <iosfwd>
#include <map>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

/// A material. The scene delegate's GetMaterialResource holds its HdMaterialNetworkMap.
class HdMaterial : public HdSprim {
  public:
    enum DirtyBits : HdDirtyBits {
        Clean = 0,
        DirtyParams = 1 << 2,
        DirtyResource = 1 << 3,
        AllDirty = DirtyParams | DirtyResource
    };

    HdMaterial() = delete;
    HdMaterial(HdMaterial const &) = delete;
    HdMaterial &operator=(HdMaterial const &) = delete;
    HD_API ~HdMaterial() override;

  protected:
    HD_API HdMaterial(SdfPath const &id);
};

/// An edge of a network. Its 'input' is the node that gives a value: data flows from input to
/// output.
struct HdMaterialRelationship {
    SdfPath inputId;
    TfToken inputName;
    SdfPath outputId;
    TfToken outputName;
};

/// A shader and the values authored on it.
struct HdMaterialNode {
    SdfPath path;
    TfToken identifier;
    std::map<TfToken, VtValue> parameters;
};

/// The nodes that one terminal needs, in the order in which data flows; the last is the terminal's.
struct HdMaterialNetwork {
    std::vector<HdMaterialRelationship> relationships;
    std::vector<HdMaterialNode> nodes;
    TfTokenVector primvars;
};

/// A material's networks by terminal: 'surface', 'displacement', 'volume'.
struct HdMaterialNetworkMap {
    std::map<TfToken, HdMaterialNetwork> map;
    std::vector<SdfPath> terminals;

    /// Settings of the whole material; not in 24.11 and before.
    VtDictionary config;
};

HD_API bool operator==(HdMaterialRelationship const &lhs, HdMaterialRelationship const &rhs);
HD_API bool operator==(HdMaterialNode const &lhs, HdMaterialNode const &rhs);
HD_API bool operator==(HdMaterialNetwork const &lhs, HdMaterialNetwork const &rhs);
HD_API bool operator!=(HdMaterialNetwork const &lhs, HdMaterialNetwork const &rhs);
HD_API std::ostream &operator<<(std::ostream &out, HdMaterialNetwork const &network);
HD_API bool operator==(HdMaterialNetworkMap const &lhs, HdMaterialNetworkMap const &rhs);
HD_API bool operator!=(HdMaterialNetworkMap const &lhs, HdMaterialNetworkMap const &rhs);
HD_API std::ostream &operator<<(std::ostream &out, HdMaterialNetworkMap const &networkMap);

PXR_NAMESPACE_CLOSE_SCOPE

#endif
