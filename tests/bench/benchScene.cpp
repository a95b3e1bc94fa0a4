#include "benchScene.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace {

/// Takes little-endian values off a file; throws where the file ends too early.
class Reader {
  public:
    explicit Reader(const std::string& path) : _file(path, std::ios::binary) {}

    bool IsOpen() const { return _file.is_open(); }

    template <class T>
    T Value() {
        T value;
        _Read(&value, sizeof(T));
        return value;
    }

    int Int() { return Value<int32_t>(); }

    /// An array with its length before it.
    template <class T>
    std::vector<T> Array() {
        const uint32_t count = Value<uint32_t>();
        if (count > kLongestArray) {
            throw std::runtime_error("an array is too long");
        }
        std::vector<T> values(count);
        _Read(values.data(), count * sizeof(T));
        return values;
    }

    std::string String() {
        const std::vector<char> text = Array<char>();
        return std::string(text.begin(), text.end());
    }

    cc::AffineTransform Transform() {
        return cc::AffineTransform(Value<std::array<std::array<double, 4>, 3>>());
    }

  private:
    static constexpr uint32_t kLongestArray = 1u << 30;

    void _Read(void* to, size_t bytes) {
        if (!_file.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes))) {
            throw std::runtime_error("the file ends too early");
        }
    }

    std::ifstream _file;
};

cc::Camera ReadCamera(Reader* reader) {
    cc::Camera camera;
    camera.cameraToWorld = reader->Transform();
    camera.orthographic = reader->Int() != 0;
    camera.windowLower = reader->Value<cc::Vec2f>();
    camera.windowUpper = reader->Value<cc::Vec2f>();
    camera.clipNear = reader->Value<float>();
    camera.clipFar = reader->Value<float>();
    return camera;
}

cc::ControlMesh ReadTopology(Reader* reader) {
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

BenchMesh ReadMesh(Reader* reader) {
    BenchMesh mesh;
    mesh.name = reader->String();
    mesh.objectToWorld = reader->Transform();
    mesh.topology = ReadTopology(reader);
    mesh.points = reader->Array<cc::Vec3f>();
    return mesh;
}

}  // namespace

std::string ReadBenchScene(const std::string& path, BenchScene* scene) {
    Reader reader(path);
    if (!reader.IsOpen()) {
        return path + ": cannot be opened";
    }
    try {
        const auto magic = reader.Value<std::array<char, 8>>();
        if (std::memcmp(magic.data(), "ccbench1", magic.size()) != 0) {
            return path + ": is no exported scene";
        }
        scene->camera = ReadCamera(&reader);
        const uint32_t count = reader.Value<uint32_t>();
        for (uint32_t i = 0; i < count; ++i) {
            scene->meshes.push_back(ReadMesh(&reader));
        }
    } catch (const std::exception& failure) {
        return path + ": " + failure.what();
    }
    return std::string();
}
