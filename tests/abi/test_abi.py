"""The declarations of Hydra must be what the library is; planted mistakes prove that this tells."""

from pathlib import Path

import pytest
from _lib import sdk as sdk_module

from abi.elf import Library
from abi.headers import Headers
from abi.layout import check_sizes, check_symbols, check_vtables
from abi.values import check_values


@pytest.fixture(scope="session")
def sdk() -> sdk_module.Sdk:
    return sdk_module.ensure(quiet=True)


@pytest.fixture(scope="session")
def library(sdk: sdk_module.Sdk) -> Library:
    return Library(sdk.runtime / "libusd_ms.so")


@pytest.fixture
def headers(tmp_path: Path) -> Headers:
    return Headers(tmp_path / "declarations")


def test_virtual_tables_and_sizes(sdk, headers, library, tmp_path):
    assert check_vtables(sdk, headers, library, tmp_path) == []
    assert check_sizes(sdk, headers, library, tmp_path) == []


def test_symbols(sdk, headers, library, tmp_path):
    assert check_symbols(sdk, headers, library, tmp_path) == []


def test_values(sdk, headers, tmp_path):
    assert check_values(sdk, headers, tmp_path) == []


def test_mistakes_in_layout_are_told(sdk, headers, library, tmp_path):
    visible = "HD_API virtual bool GetVisible(SdfPath const &id);"
    sided = "HD_API virtual bool GetDoubleSided(SdfPath const &id);"
    headers.plant("hd/sceneDelegate.h", f"{visible}\n    {sided}", f"{sided}\n    {visible}")
    headers.plant("hd/renderPass.h", "HD_API virtual void _MarkCollectionDirty();", "")
    headers.plant("hd/renderBuffer.h", "bool multiSampled) = 0;", "int multiSampled) = 0;")
    headers.plant("hd/renderBuffer.h", "bool IsConverged() const = 0;", "bool IsConverged() const;")
    headers.plant(
        "hd/instancer.h", "GetInitialDirtyBitsMask() const;", "GetInitialDirtyBitsMask();"
    )
    headers.plant("hd/renderDelegate.h", "    HD_API virtual void Update();",
                  "    HD_API virtual void Update();\n    virtual void More();")  # fmt: skip
    headers.plant("hd/light.h", "    SdfPath _instancerId;", "    SdfPath _instancerId, _more;")
    headers.plant("hd/camera.h", "    float _exposureTime;\n    float _exposureIso;\n", "")
    headers.plant("hd/rprimCollection.h", "    SdfPathVector _excludePaths;\n", "")

    told = check_vtables(sdk, headers, library, tmp_path)

    assert_told(told, "HdSceneDelegate, slot 10: GetDoubleSided", "HdSceneDelegate, slot 11: GetV")
    assert_told(told, "HdRenderPass: 5 virtual functions declared, 6 in all")
    assert_told(told, "HdRenderBuffer, slot 5: Allocate", "HdRenderBuffer, slot 15: IsConverged")
    assert_told(told, "HdInstancer, slot 4: GetInitialDirtyBitsMask() should be")
    assert_told(told, "HdRenderDelegate: 48 virtual functions declared, 47 in all")
    assert classes_in(told) == {
        "HdSceneDelegate", "HdRenderPass", "HdRenderBuffer", "HdInstancer", "HdRenderDelegate"
    }  # fmt: skip

    told = check_sizes(sdk, headers, library, tmp_path)

    assert_told(told, "HdLight: declared with 32 bytes, has 24")
    assert_told(told, "HdCamera: declared with 328 bytes, has 336")
    # A pass holds a collection, so it is told too.
    assert classes_in(told) == {"HdLight", "HdCamera", "HdRprimCollection", "HdRenderPass"}


def test_mistakes_in_symbols_are_told(sdk, headers, library, tmp_path):
    headers.plant("hd/rprim.h", "SetMaterialId(SdfPath const &materialId)",
                  "SetMaterialId(SdfPath materialId)")  # fmt: skip
    headers.plant("hd/meshTopology.h", "GetNumPoints() const", "GetNumPoints()")
    headers.plant("hd/aov.h", "HdAovHasDepthSemantic", "HdAovHasDepthMeaning")

    told = check_symbols(sdk, headers, library, tmp_path)

    assert_told(told, "HdRprim::SetMaterialId(", "HdMeshTopology::GetNumPoints()")
    assert_told(told, "HdAovHasDepthMeaning(")
    assert len(told) == 3


# Where members change places, what is read is the other one's value; where an enumerator is put
# in, what follows has another's number.
SWAPPED = {
    "hd/camera.h": ("float _fStop;", "float _focusDistance;"),
    "hd/rprim.h": ("SdfPath _instancerId;", "SdfPath _materialId;"),
    "hd/renderPassState.h": ("GfVec4f _viewport;", "CameraUtilFraming _framing;"),
    "hd/changeTracker.h": ("DirtyTransform = 1 << 9", "DirtyVisibility = 1 << 10"),
    "pxOsd/subdivTags.h": ("TfToken _creaseMethod;", "TfToken _triangleRule;"),
    "cameraUtil/conformWindow.h": ("Fit = 2", "Crop = 3"),
}
INSERTED = {"hd/types.h": ("HdFormatInt16Vec4,", "HdFormatInt16Vec4,\n    HdFormatNew,")}


def test_mistakes_in_values_are_told(sdk, headers, tmp_path):
    for file, (first, second) in SWAPPED.items():
        swap(headers, file, first, second)
    for file, (old, new) in INSERTED.items():
        headers.plant(file, old, new)

    told = check_values(sdk, headers, tmp_path)

    assert_told(told, "camera.GetFStop() == 18.0f", "camera.GetFocusDistance() == 19.0f")
    assert_told(told, "mesh.GetMaterialId() ==", "mesh.GetInstancerId() ==")
    assert_told(told, "state.GetViewport() ==", "state.GetFraming() == framing")
    assert_told(told, "dirty bit 512 means something else", "dirty bit 1024 means something else")
    assert_told(told, "missing 'triangleRule' in", "CameraUtilCrop is called CameraUtilFit")
    assert_told(told, "HdFormatFloat32UInt8 is called", "HdFormatInt32Vec4 is called")


def swap(headers: Headers, file: str, first: str, second: str) -> None:
    """Lets two members, or two enumerators' values, change places."""
    if "=" in first:
        (name, value), (other, other_value) = first.split(" = "), second.split(" = ")
        headers.plant(file, first, f"{name} = {other_value}")
        headers.plant(file, second, f"{other} = {value}")
    else:
        headers.plant(file, f"    {first}", "    @")
        headers.plant(file, f"    {second}", f"    {first}")
        headers.plant(file, "    @", f"    {second}")


def assert_told(told: list[str], *beginnings: str) -> None:
    """Each of the texts must be in one of the lines."""
    for text in beginnings:
        assert any(text in line for line in told), f"nothing told of {text}:\n" + "\n".join(told)


def classes_in(told: list[str]) -> set[str]:
    """The classes that the lines begin with."""
    return {line.replace(",", ":").split(":")[0] for line in told}
