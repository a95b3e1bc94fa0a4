// Makes a compiler show what it understands of the declarations: a virtual table for a class
// derived from each polymorphic one, and for each class a symbol that is as large as an object.

#include "allHeaders.h"

PXR_NAMESPACE_OPEN_SCOPE

#define POLYMORPHIC(CLASS)            \
    class Abi##CLASS : public CLASS { \
        ~Abi##CLASS() override;       \
    };                                \
    Abi##CLASS::~Abi##CLASS() {}      \
    char abiSize##CLASS[sizeof(CLASS)] = {1};

POLYMORPHIC(HdBasisCurves)
POLYMORPHIC(HdBasisCurvesTopology)
POLYMORPHIC(HdBprim)
POLYMORPHIC(HdCamera)
POLYMORPHIC(HdExtComputation)
POLYMORPHIC(HdInstancer)
POLYMORPHIC(HdLight)
POLYMORPHIC(HdMaterial)
POLYMORPHIC(HdMesh)
POLYMORPHIC(HdMeshTopology)
POLYMORPHIC(HdPoints)
POLYMORPHIC(HdRenderBuffer)
POLYMORPHIC(HdRenderDelegate)
POLYMORPHIC(HdRenderParam)
POLYMORPHIC(HdRenderPass)
POLYMORPHIC(HdRenderPassState)
POLYMORPHIC(HdRendererPlugin)
POLYMORPHIC(HdRprim)
POLYMORPHIC(HdRprimCollection)
POLYMORPHIC(HdSceneDelegate)
POLYMORPHIC(HdSprim)
POLYMORPHIC(HfPluginBase)
POLYMORPHIC(HfPluginRegistry)

// Only ever pointed to, so their size does not matter.
#undef POLYMORPHIC
#define POLYMORPHIC(CLASS)            \
    class Abi##CLASS : public CLASS { \
        ~Abi##CLASS() override;       \
    };                                \
    Abi##CLASS::~Abi##CLASS() {}

POLYMORPHIC(HdChangeTracker)
POLYMORPHIC(HdResourceRegistry)

PXR_NAMESPACE_CLOSE_SCOPE
