#include "benchScene.h"

#include "binaryReader.h"
#include "core/math/box.h"

namespace {

cc::AffineTransform ReadTransform(BinaryReader* reader) {
    return cc::AffineTransform(reader->Value<std::array<std::array<double, 4>, 3>>());
}

cc::Camera ReadCamera(BinaryReader* reader) {
    cc::Camera camera;
    camera.cameraToWorld = ReadTransform(reader);
    camera.orthographic = reader->Int() != 0;
    camera.windowLower = reader->Value<cc::Vec2f>();
    camera.windowUpper = reader->Value<cc::Vec2f>();
    camera.clipNear = reader->Value<float>();
    camera.clipFar = reader->Value<float>();
    return camera;
}

cc::ControlMesh ReadTopology(BinaryReader* reader) {
    cc::ControlMesh mesh;
    mesh.scheme = static_cast<cc::Scheme>(reader->Int());
    mesh.boundaryRule = static_cast<cc::BoundaryRule>(reader->Int());
    mesh.triangleRule = static_cast<cc::TriangleRule>(reader->Int());
    mesh.leftHanded = reader->Int() != 0;
    mesh.faceVertexCounts = reader->Array<int>();
    mesh.faceVertexIndices = reader->Array<int>();
    mesh.holeIndices = reader->Array<int>();
    mesh.creaseIndices = reader->Array<int>();
    mesh.creaseLengths = reader->Array<int>();
    mesh.creaseSharpnesses = reader->Array<float>();
    mesh.cornerIndices = reader->Array<int>();
    mesh.cornerSharpnesses = reader->Array<float>();
    return mesh;
}

BenchMesh ReadMesh(BinaryReader* reader) {
    BenchMesh mesh;
    mesh.name = reader->String();
    mesh.objectToWorld = ReadTransform(reader);
    mesh.topology = ReadTopology(reader);
    mesh.points = reader->Array<cc::Vec3f>();
    return mesh;
}

}  // namespace

BenchScene ReadBenchScene(const std::string& path) {
    BinaryReader reader(path, "ccbench2");
    BenchScene scene;
    scene.camera = ReadCamera(&reader);
    for (cc::Vec3f& light : scene.lights) {
        light = reader.Value<cc::Vec3f>();
    }
    const uint32_t count = reader.Value<uint32_t>();
    for (uint32_t i = 0; i < count; ++i) {
        scene.meshes.push_back(ReadMesh(&reader));
    }
    return scene;
}

std::vector<cc::Vec3f> RippledPoints(const BenchMesh& mesh, float phase) {
    cc::Box3f bounds;
    for (const cc::Vec3f& point : mesh.points) {
        bounds.Extend(point);
    }
    const float size = Length(bounds.upper - bounds.lower);
    std::vector<cc::Vec3f> moved = mesh.points;
    if (!(size > 0)) {
        return moved;
    }
    for (cc::Vec3f& point : moved) {
        point.y += 0.01f * size * std::sin(20 * (point.x + point.z) / size + phase);
    }
    return moved;
}
