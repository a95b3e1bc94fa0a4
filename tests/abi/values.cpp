// Hands values through the library and looks at what arrives on the other side: members that are
// read by inline functions, and enums. Loaded into a process that has the library already.

#include "allHeaders.h"

#include "pxr/base/tf/enum.h"

#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

namespace {

std::ostringstream problems;

void expect(bool holds, char const *what) {
    if (!holds) problems << what << '\n';
}

#define EXPECT(CONDITION) expect(CONDITION, #CONDITION)

TfToken token(char const *text) { return TfToken(text); }

/// Supports nothing, so that an index needs no prims of it.
class Delegate : public HdRenderDelegate {
  public:
    Delegate() = default;
    Delegate(HdRenderSettingsMap const &settings) : HdRenderDelegate(settings) {}
    TfTokenVector const &GetSupportedRprimTypes() const override { return _none; }
    TfTokenVector const &GetSupportedSprimTypes() const override { return _none; }
    TfTokenVector const &GetSupportedBprimTypes() const override { return _none; }
    HdResourceRegistrySharedPtr GetResourceRegistry() const override { return nullptr; }
    HdRenderPassSharedPtr CreateRenderPass(HdRenderIndex *, HdRprimCollection const &) override {
        return nullptr;
    }
    HdInstancer *CreateInstancer(HdSceneDelegate *, SdfPath const &) override { return nullptr; }
    void DestroyInstancer(HdInstancer *) override {}
    HdRprim *CreateRprim(TfToken const &, SdfPath const &) override { return nullptr; }
    void DestroyRprim(HdRprim *) override {}
    HdSprim *CreateSprim(TfToken const &, SdfPath const &) override { return nullptr; }
    HdSprim *CreateFallbackSprim(TfToken const &) override { return nullptr; }
    void DestroySprim(HdSprim *) override {}
    HdBprim *CreateBprim(TfToken const &, SdfPath const &) override { return nullptr; }
    HdBprim *CreateFallbackBprim(TfToken const &) override { return nullptr; }
    void DestroyBprim(HdBprim *) override {}
    void CommitResources(HdChangeTracker *) override {}

    void populate() {
        _PopulateDefaultSettings({{"A", token("a"), VtValue(2)}, {"B", token("b"), VtValue(3)}});
    }
    HdRenderSettingsMap const &settings() const { return _settingsMap; }
    unsigned int version() const { return _settingsVersion; }

  private:
    TfTokenVector _none;
};

/// Answers with values that no two questions share.
class Scene : public HdSceneDelegate {
  public:
    Scene() : HdSceneDelegate(index(), SdfPath("/delegate")) {}

    static HdRenderIndex *index() {
        static Delegate delegate;
        static HdRenderIndex *const made = HdRenderIndex::New(&delegate, {});
        return made;
    }

    GfMatrix4d GetTransform(SdfPath const &) override { return GfMatrix4d(7.0); }
    bool GetVisible(SdfPath const &) override { return false; }
    TfToken GetRenderTag(SdfPath const &) override { return token("guide"); }
    SdfPath GetInstancerId(SdfPath const &) override { return SdfPath("/instancer"); }
    HdReprSelector GetReprSelector(SdfPath const &) override {
        return HdReprSelector(token("refined"), token("cage"), token("points"));
    }
    VtValue GetCameraParamValue(SdfPath const &, TfToken const &name) override {
        auto const found = camera.find(name.GetString());
        return found == camera.end() ? VtValue() : found->second;
    }

    std::map<std::string, VtValue> camera = {
        {"projection", VtValue(HdCamera::Orthographic)},
        {"horizontalAperture", VtValue(11.0f)},
        {"verticalAperture", VtValue(12.0f)},
        {"horizontalApertureOffset", VtValue(13.0f)},
        {"verticalApertureOffset", VtValue(14.0f)},
        {"focalLength", VtValue(15.0f)},
        {"clippingRange", VtValue(GfRange1f(16.0f, 17.0f))},
        {"clipPlanes", VtValue(std::vector<GfVec4d>{GfVec4d(1, 2, 3, 4)})},
        {"fStop", VtValue(18.0f)},
        {"focusDistance", VtValue(19.0f)},
        {"focusOn", VtValue(true)},
        {"dofAspect", VtValue(20.0f)},
        {"splitDiopter:count", VtValue(21)},
        {"splitDiopter:angle", VtValue(22.0f)},
        {"splitDiopter:offset1", VtValue(23.0f)},
        {"splitDiopter:width1", VtValue(24.0f)},
        {"splitDiopter:focusDistance1", VtValue(25.0f)},
        {"splitDiopter:offset2", VtValue(26.0f)},
        {"splitDiopter:width2", VtValue(27.0f)},
        {"splitDiopter:focusDistance2", VtValue(28.0f)},
        {"shutterOpen", VtValue(29.0)},
        {"shutterClose", VtValue(30.0)},
        {"exposure", VtValue(31.0f)},
        {"linearExposureScale", VtValue(32.0f)},
        {"lensDistortion:type", VtValue(token("fisheye"))},
        {"lensDistortion:k1", VtValue(33.0f)},
        {"lensDistortion:k2", VtValue(34.0f)},
        {"lensDistortion:center", VtValue(GfVec2f(35, 36))},
        {"lensDistortion:anaSq", VtValue(37.0f)},
        {"lensDistortion:asym", VtValue(GfVec2f(38, 39))},
        {"lensDistortion:scale", VtValue(40.0f)},
        {"lensDistortion:ior", VtValue(41.0f)},
        {"windowPolicy", VtValue(CameraUtilCrop)},
    };
};

void checkDelegate() {
    HdRenderSettingsMap given;
    given[token("a")] = VtValue(1);
    Delegate delegate(given);
    unsigned int const before = delegate.version();
    delegate.populate();
    EXPECT(delegate.settings().size() == 2);
    EXPECT(delegate.GetRenderSetting(token("a")) == VtValue(1));
    EXPECT(delegate.GetRenderSetting<float>(token("b"), 0.0f) == 3.0f);
    delegate.SetRenderSetting(token("b"), VtValue(4));
    EXPECT(delegate.settings().find(token("b"))->second == VtValue(4));
    EXPECT(delegate.version() == before + 1);
    EXPECT(delegate.GetRenderSettingsVersion() == delegate.version());
    EXPECT(delegate.GetRendererDisplayName().empty());
    EXPECT(Scene::index()->GetRenderDelegate() != nullptr);
}

void checkScene() {
    Scene scene;
    EXPECT(&scene.GetRenderIndex() == Scene::index());
    EXPECT(scene.GetDelegateID() == SdfPath("/delegate"));
}

void checkCamera() {
    Scene scene;
    HdCamera camera(SdfPath("/camera"));
    EXPECT(camera.GetId() == SdfPath("/camera"));
    EXPECT(camera.GetInitialDirtyBitsMask() == HdCamera::AllDirty);

    HdDirtyBits transform = HdCamera::DirtyTransform;
    camera.Sync(&scene, nullptr, &transform);
    EXPECT(camera.GetTransform() == GfMatrix4d(7.0));
    EXPECT(camera.GetFocalLength() != 15.0f);
    HdDirtyBits planes = HdCamera::DirtyClipPlanes;
    camera.Sync(&scene, nullptr, &planes);
    EXPECT(camera.GetClipPlanes() == HdCamera::ClipPlanesVector{GfVec4d(1, 2, 3, 4)});
    EXPECT(camera.GetWindowPolicy() != CameraUtilCrop);
    HdDirtyBits policy = HdCamera::DirtyWindowPolicy;
    camera.Sync(&scene, nullptr, &policy);
    EXPECT(camera.GetWindowPolicy() == CameraUtilCrop);
    EXPECT(camera.GetFocalLength() != 15.0f);
    HdDirtyBits parameters = HdCamera::DirtyParams;
    camera.Sync(&scene, nullptr, &parameters);

    EXPECT(camera.GetProjection() == HdCamera::Orthographic);
    EXPECT(camera.GetHorizontalAperture() == 11.0f);
    EXPECT(camera.GetVerticalAperture() == 12.0f);
    EXPECT(camera.GetHorizontalApertureOffset() == 13.0f);
    EXPECT(camera.GetVerticalApertureOffset() == 14.0f);
    EXPECT(camera.GetFocalLength() == 15.0f);
    EXPECT(camera.GetClippingRange() == GfRange1f(16.0f, 17.0f));
    EXPECT(camera.GetFStop() == 18.0f);
    EXPECT(camera.GetFocusDistance() == 19.0f);
    EXPECT(camera.GetFocusOn());
    EXPECT(camera.GetDofAspect() == 20.0f);
    EXPECT(camera.GetSplitDiopterCount() == 21);
    EXPECT(camera.GetSplitDiopterAngle() == 22.0f);
    EXPECT(camera.GetSplitDiopterOffset1() == 23.0f);
    EXPECT(camera.GetSplitDiopterWidth1() == 24.0f);
    EXPECT(camera.GetSplitDiopterFocusDistance1() == 25.0f);
    EXPECT(camera.GetSplitDiopterOffset2() == 26.0f);
    EXPECT(camera.GetSplitDiopterWidth2() == 27.0f);
    EXPECT(camera.GetSplitDiopterFocusDistance2() == 28.0f);
    EXPECT(camera.GetShutterOpen() == 29.0);
    EXPECT(camera.GetShutterClose() == 30.0);
    EXPECT(camera.GetExposure() == 31.0f);
    EXPECT(camera.GetLinearExposureScale() == 32.0f);
    EXPECT(camera.GetLensDistortionType() == token("fisheye"));
    EXPECT(camera.GetLensDistortionK1() == 33.0f);
    EXPECT(camera.GetLensDistortionK2() == 34.0f);
    EXPECT(camera.GetLensDistortionCenter() == GfVec2f(35, 36));
    EXPECT(camera.GetLensDistortionAnaSq() == 37.0f);
    EXPECT(camera.GetLensDistortionAsym() == GfVec2f(38, 39));
    EXPECT(camera.GetLensDistortionScale() == 40.0f);
    EXPECT(camera.GetLensDistortionIor() == 41.0f);
}

class Mesh : public HdMesh {
  public:
    Mesh(SdfPath const &id) : HdMesh(id) {}
    HdDirtyBits GetInitialDirtyBitsMask() const override { return HdChangeTracker::AllDirty; }
    void Sync(HdSceneDelegate *, HdRenderParam *, HdDirtyBits *, TfToken const &) override {}
    HdDirtyBits _PropagateDirtyBits(HdDirtyBits bits) const override { return bits; }
    void _InitRepr(TfToken const &, HdDirtyBits *) override {}

    void update(Scene &scene) {
        HdDirtyBits bits = HdChangeTracker::AllDirty;
        _UpdateInstancer(&scene, &bits);
        _UpdateVisibility(&scene, &bits);
        UpdateReprSelector(&scene, &bits);
        UpdateRenderTag(&scene, nullptr);
    }
    bool findsRepr() {
        _reprs.emplace_back(token("hull"), nullptr);
        _reprs.emplace_back(token("smoothHull"), nullptr);
        return &_GetRepr(token("smoothHull")) == &_reprs[1].second;
    }
};

void checkMesh() {
    Scene scene;
    Mesh mesh(SdfPath("/mesh"));
    EXPECT(mesh.GetId() == SdfPath("/mesh"));
    EXPECT(mesh.IsVisible());
    mesh.SetPrimId(5);
    mesh.SetMaterialId(SdfPath("/material"));
    mesh.update(scene);
    EXPECT(mesh.GetPrimId() == 5);
    EXPECT(mesh.GetMaterialId() == SdfPath("/material"));
    EXPECT(mesh.GetInstancerId() == SdfPath("/instancer"));
    EXPECT(!mesh.IsVisible());
    EXPECT(mesh.GetRenderTag() == token("guide"));
    EXPECT(mesh.GetReprSelector()[0] == token("refined"));
    EXPECT(mesh.GetReprSelector()[1] == token("cage"));
    EXPECT(mesh.GetReprSelector()[2] == token("points"));
    EXPECT(mesh.findsRepr());
    EXPECT(mesh.GetTopology() == nullptr);
}

class Light : public HdLight {
  public:
    using HdLight::HdLight;
    void Sync(HdSceneDelegate *, HdRenderParam *, HdDirtyBits *) override {}
    HdDirtyBits GetInitialDirtyBitsMask() const override { return AllDirty; }
};

class Instancer : public HdInstancer {
  public:
    using HdInstancer::_UpdateInstancer;
    using HdInstancer::HdInstancer;
};

void checkInstancing() {
    Scene scene;
    Light light(SdfPath("/light"));
    HdDirtyBits lightBits = HdLight::DirtyInstancer;
    light._UpdateInstancer(&scene, &lightBits);
    EXPECT(light.GetId() == SdfPath("/light"));
    EXPECT(light.GetInstancerId() == SdfPath("/instancer"));

    Instancer instancer(&scene, SdfPath("/self"));
    HdDirtyBits bits = HdChangeTracker::DirtyInstancer;
    instancer._UpdateInstancer(&scene, &bits);
    EXPECT(instancer.GetId() == SdfPath("/self"));
    EXPECT(instancer.GetParentId() == SdfPath("/instancer"));
    EXPECT(instancer.GetDelegate() == &scene);
}

class Pass : public HdRenderPass {
  public:
    using HdRenderPass::HdRenderPass;
    void _Execute(HdRenderPassStateSharedPtr const &, TfTokenVector const &) override {}
};

void checkPass() {
    HdRprimCollection collection(token("geometry"), HdReprSelector(token("smoothHull")), true,
                                 token("materialTag"));
    EXPECT(collection.GetName() == token("geometry"));
    EXPECT(collection.GetReprSelector()[0] == token("smoothHull"));
    EXPECT(collection.IsForcedRepr());
    EXPECT(collection.GetMaterialTag() == token("materialTag"));

    Pass pass(Scene::index(), collection);
    EXPECT(pass.GetRenderIndex() == Scene::index());
    EXPECT(pass.GetRprimCollection() == collection);
}

void checkPassState() {
    HdCamera camera(SdfPath("/camera"));
    HdRenderPassState state;
    EXPECT(state.GetCamera() == nullptr);
    EXPECT(!state.GetFraming().IsValid());
    EXPECT(!state.GetOverrideWindowPolicy());

    CameraUtilFraming const framing(GfRange2f(GfVec2f(1, 2), GfVec2f(30, 40)),
                                    GfRect2i(GfVec2i(5, 6), 7, 8), 1.5f);
    EXPECT(framing.displayWindow == GfRange2f(GfVec2f(1, 2), GfVec2f(30, 40)));
    EXPECT(framing.dataWindow == GfRect2i(GfVec2i(5, 6), 7, 8));
    EXPECT(framing.pixelAspectRatio == 1.5f);

    state.SetCamera(&camera);
    state.SetViewport(GfVec4d(1, 2, 3, 4));
    state.SetFraming(framing);
    state.SetOverrideWindowPolicy(CameraUtilMatchHorizontally);
    EXPECT(state.GetCamera() == &camera);
    EXPECT(state.GetViewport() == GfVec4f(1, 2, 3, 4));
    EXPECT(state.GetFraming() == framing);
    EXPECT(state.GetOverrideWindowPolicy() == CameraUtilMatchHorizontally);
    EXPECT(state.GetWindowPolicy() == CameraUtilMatchHorizontally);
}

/// What the library prints of an object must have these words in this order.
template <typename T>
bool prints(T const &object, std::vector<std::string> const &words) {
    std::ostringstream out;
    out << object;
    std::string const text = out.str();
    size_t from = 0;
    for (std::string const &word : words) {
        from = text.find(word, from);
        if (from == std::string::npos) {
            problems << "missing '" << word << "' in: " << text << '\n';
            return false;
        }
        from += word.size();
    }
    return true;
}

void checkTopology() {
    PxOsdSubdivTags const tags(token("vertexRule"), token("fvarRule"), token("creaseMethod"),
                               token("triangleRule"), {1, 2}, {2}, {3.5f}, {3}, {4.5f});
    EXPECT(prints(tags, {"vertexRule", "fvarRule", "creaseMethod", "triangleRule", "1, 2", "2",
                         "3.5", "3", "4.5"}));
    PxOsdMeshTopology const osd(token("loop"), token("leftHanded"), {3, 3}, {0, 1, 2, 2, 1, 3}, {1},
                                tags);
    EXPECT(osd.GetScheme() == token("loop"));
    EXPECT(osd.GetOrientation() == token("leftHanded"));
    EXPECT((osd.GetFaceVertexCounts() == VtIntArray{3, 3}));
    EXPECT((osd.GetFaceVertexIndices() == VtIntArray{0, 1, 2, 2, 1, 3}));
    EXPECT((osd.GetHoleIndices() == VtIntArray{1}));
    EXPECT(osd.GetSubdivTags() == tags);

    HdMeshTopology topology(osd, 6);
    EXPECT(topology.GetPxOsdMeshTopology() == osd);
    EXPECT(topology.GetRefineLevel() == 6);
    EXPECT(topology.GetNumPoints() == 4);
    EXPECT(topology.GetNumFaces() == 2);
    EXPECT(HdMeshTopology(topology, 2).GetRefineLevel() == 2);
    EXPECT(topology.GetGeomSubsets().empty() && topology.GetInvisibleFaces().empty());

    PxOsdMeshTopology const ourCopy = osd;
    EXPECT(ourCopy == osd);
}

/// Members of a topology that only an application sets.
class FilledTopology : public HdMeshTopology {
  public:
    FilledTopology() : HdMeshTopology(PxOsdMeshTopology(), 0) {
        HdGeomSubset subset{HdGeomSubset::TypeFaceSet, SdfPath("/a"), SdfPath("/b"), {1, 2}};
        _geomSubsets = {subset, subset};
        _invisiblePoints = {3};
        _invisibleFaces = {4};
    }
};

void checkSubsets() {
    FilledTopology const filled;
    HdMeshTopology const copy(filled, 0);
    EXPECT(copy.GetGeomSubsets().size() == 2);
    EXPECT(copy.GetGeomSubsets()[1] == filled.GetGeomSubsets()[1]);
    EXPECT(copy.GetGeomSubsets()[1].materialId == SdfPath("/b"));
    EXPECT((copy.GetGeomSubsets()[1].indices == VtIntArray{1, 2}));
    EXPECT(copy.GetInvisiblePoints() == VtIntArray{3});
    EXPECT(copy.GetInvisibleFaces() == VtIntArray{4});

    HdGeomSubset other = filled.GetGeomSubsets()[0];
    EXPECT(other == filled.GetGeomSubsets()[0]);
    other.indices = {9};
    EXPECT(!(other == filled.GetGeomSubsets()[0]));
}

void checkMaterial() {
    HdMaterialRelationship const edge{SdfPath("/in"), token("out"), SdfPath("/to"), token("dest")};
    HdMaterialNode const node{SdfPath("/node"), token("Shader"), {{token("key"), VtValue(0.25f)}}};
    HdMaterialNetwork const network{{edge, edge}, {node, node}, {token("st")}};
    HdMaterialNetworkMap map;
    map.map[token("surface")] = network;
    map.terminals = {SdfPath("/node")};
    HdMaterialNetworkMap other = map;
    EXPECT(map == other);
    other.config["setting"] = VtValue(1);
    EXPECT(map != other);
    other = map;
    other.terminals.clear();
    EXPECT(map != other);
    other = map;
    other.map[token("surface")].relationships[1].outputName = token("else");
    EXPECT(map != other);
    other = map;
    other.map[token("surface")].nodes[1].identifier = token("else");
    EXPECT(map != other);
    other = map;
    other.map[token("surface")].primvars.clear();
    EXPECT(map != other);
}

void checkAovs() {
    HdRenderPassAovBinding binding;
    binding.aovName = token("depth");
    binding.renderBufferId = SdfPath("/buffer");
    binding.clearValue = VtValue(0.75f);
    binding.aovSettings[token("filter")] = VtValue(5);
    EXPECT(prints(binding, {"depth", "/buffer", "0.75"}));

    HdRenderPassState state;
    state.SetAovBindings({binding, binding});
    EXPECT(state.GetAovBindings().size() == 2);
    EXPECT(state.GetAovBindings()[1] == binding);
    EXPECT(state.GetAovBindings()[1].clearValue == VtValue(0.75f));
    EXPECT(state.GetAovBindings()[1].aovSettings.count(token("filter")) == 1);

    HdParsedAovToken const primvar(token("primvars:st"));
    EXPECT(primvar.name == token("st") && primvar.isPrimvar && !primvar.isLpe);
    HdParsedAovToken const lpe(token("lpe:C.*"));
    EXPECT(lpe.name == token("C.*") && lpe.isLpe && !lpe.isShader);
    EXPECT(HdParsedAovToken(token("shader:x")).isShader);
}

void checkDirtyBits() {
    SdfPath const id("/mesh");
    using Tracker = HdChangeTracker;
    struct {
        HdDirtyBits bit;
        bool (*isDirty)(HdDirtyBits, SdfPath const &);
    } const questions[] = {
        {Tracker::DirtyExtent, &Tracker::IsExtentDirty},
        {Tracker::DirtyDisplayStyle, &Tracker::IsDisplayStyleDirty},
        {Tracker::DirtySubdivTags, &Tracker::IsSubdivTagsDirty},
        {Tracker::DirtyTopology, &Tracker::IsTopologyDirty},
        {Tracker::DirtyDoubleSided, &Tracker::IsDoubleSidedDirty},
        {Tracker::DirtyCullStyle, &Tracker::IsCullStyleDirty},
        {Tracker::DirtyTransform, &Tracker::IsTransformDirty},
        {Tracker::DirtyVisibility, &Tracker::IsVisibilityDirty},
        {Tracker::DirtyPrimID, &Tracker::IsPrimIdDirty},
        {Tracker::DirtyInstancer, &Tracker::IsInstancerDirty},
        {Tracker::DirtyInstanceIndex, &Tracker::IsInstanceIndexDirty},
        {Tracker::DirtyRepr, &Tracker::IsReprDirty},
    };
    for (auto const &question : questions)
        if (!question.isDirty(question.bit, id) ||
            question.isDirty(Tracker::AllDirty & ~question.bit, id))
            problems << "dirty bit " << question.bit << " means something else\n";
    EXPECT(Tracker::IsPrimvarDirty(Tracker::DirtyPoints, id, token("points")));
    EXPECT(Tracker::IsPrimvarDirty(Tracker::DirtyNormals, id, token("normals")));
    EXPECT(Tracker::IsPrimvarDirty(Tracker::DirtyWidths, id, token("widths")));
    EXPECT(Tracker::IsPrimvarDirty(Tracker::DirtyPrimvar, id, token("other")));
    EXPECT(!Tracker::IsPrimvarDirty(Tracker::DirtyPoints, id, token("other")));

    struct {
        HdDirtyBits bit;
        char const *name;
    } const names[] = {
        {Tracker::DirtyMaterialId, "MaterialId"},
        {Tracker::DirtyRenderTag, "RenderTag"},
        {Tracker::DirtyComputationPrimvarDesc, "ComputationPrimvarDesc"},
        {Tracker::DirtyCategories, "Categories"},
        {Tracker::DirtyVolumeField, "VolumeField"},
        {Tracker::InitRepr, "InitRepr"},
        {Tracker::Varying, "Varying"},
        {Tracker::NewRepr, "NewRepr"},
    };
    for (auto const &named : names) {
        std::string const text = Tracker::StringifyDirtyBits(named.bit);
        if (text.find(named.name) == std::string::npos)
            problems << named.name << " is called " << text << '\n';
    }

    EXPECT(HdExtComputation(SdfPath("/x")).GetInitialDirtyBitsMask() == HdExtComputation::AllDirty);
    for (auto const &[bit, name] :
         std::map<HdDirtyBits, std::string>{{HdLight::DirtyTransform, "Transform"},
                                            {HdLight::DirtyParams, "Params"},
                                            {HdLight::DirtyShadowParams, "ShadowParams"},
                                            {HdLight::DirtyCollection, "Collection"},
                                            {HdLight::DirtyResource, "Resource"},
                                            {HdLight::DirtyInstancer, "Instancer"}}) {
        std::string const text = HdLight::StringifyDirtyBits(bit);
        if (text.find(name) == std::string::npos)
            problems << "light bit " << name << " is called " << text << '\n';
    }
}

void checkEnums() {
#define NAMED(ENUMERATOR)                                   \
    if (TfEnum::GetName(TfEnum(ENUMERATOR)) != #ENUMERATOR) \
        problems << #ENUMERATOR << " is called " << TfEnum::GetName(TfEnum(ENUMERATOR)) << '\n';
#include "enumerators.inc"
#undef NAMED
    EXPECT(HdInvertCullStyle(HdCullStyleNothing) == HdCullStyleNothing);
    EXPECT(HdInvertCullStyle(HdCullStyleBack) == HdCullStyleFront);
    EXPECT(HdInvertCullStyle(HdCullStyleBackUnlessDoubleSided) ==
           HdCullStyleFrontUnlessDoubleSided);
    EXPECT(HdGetComponentCount(HdFormatFloat32Vec3) == 3);
    EXPECT(HdGetComponentFormat(HdFormatInt32Vec4) == HdFormatInt32);
    EXPECT(HdDataSizeOfFormat(HdFormatUNorm8Vec4) == 4);
    HdTupleType const type = HdGetValueTupleType(VtValue(GfVec3f(1)));
    EXPECT(type.type == HdTypeFloatVec3 && type.count == 1);
}

}  // namespace

PXR_NAMESPACE_CLOSE_SCOPE

/// Lines that say which values did not arrive; none if all is well.
extern "C" char const *abiProblems() {
    PXR_NAMESPACE_USING_DIRECTIVE
    static std::string result;
    struct {
        char const *name;
        void (*run)();
    } const checks[] = {
        {"checkDelegate", &checkDelegate},
        {"checkScene", &checkScene},
        {"checkCamera", &checkCamera},
        {"checkMesh", &checkMesh},
        {"checkInstancing", &checkInstancing},
        {"checkPass", &checkPass},
        {"checkPassState", &checkPassState},
        {"checkTopology", &checkTopology},
        {"checkSubsets", &checkSubsets},
        {"checkMaterial", &checkMaterial},
        {"checkAovs", &checkAovs},
        {"checkDirtyBits", &checkDirtyBits},
        {"checkEnums", &checkEnums},
    };
    for (auto const &check : checks) {
        std::cerr << check.name << std::endl;  // for when it crashes
        check.run();
    }
    result = problems.str();
    return result.c_str();
}
