// Random topology, tags and points -> patches -> packets of rays. Whatever a scene says, the core
// must neither crash nor hang nor return what makes no sense.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "core/scene/scene.h"
#include "core/subdiv/limitPoint.h"
#include "core/trace/tracer.h"

namespace {

/// Reads an input byte by byte; what lies beyond its end is zero.
class Bytes {
  public:
    Bytes(const uint8_t* data, size_t size) : _data(data), _end(data + size) {}

    bool IsEmpty() const { return _data == _end; }
    int Byte() { return IsEmpty() ? 0 : *_data++; }
    /// Mostly in [0, range), and now and then anything at all.
    int Index(int range) {
        const int b = Byte();
        if (b == 255) {
            return Byte() - 128;
        }
        return range > 0 ? b % range : b;
    }
    /// Mostly a small number, and now and then any float there is.
    float Float() {
        const int b = Byte();
        if (b == 255) {
            uint32_t bits = 0;
            for (int i = 0; i < 4; ++i) {
                bits = bits << 8 | static_cast<uint32_t>(Byte());
            }
            float value;
            std::memcpy(&value, &bits, sizeof(value));
            return value;
        }
        return static_cast<float>(b - 127) / 16;
    }

  private:
    const uint8_t* _data;
    const uint8_t* const _end;
};

cc::Scheme SchemeOf(int flags) {
    switch (flags % 8) {
        case 4:
        case 5: return cc::Scheme::Loop;
        case 6: return cc::Scheme::Bilinear;
        case 7: return cc::Scheme::None;
        default: return cc::Scheme::CatmullClark;
    }
}

/// How many vertices a face has: under the Loop scheme almost always three, as others end there.
int ReadFaceSize(Bytes* bytes, cc::Scheme scheme) {
    if (scheme != cc::Scheme::Loop) {
        return bytes->Index(8);
    }
    const int b = bytes->Byte();
    return b < 250 ? 3 : b - 250;
}

cc::ControlMesh ReadMesh(Bytes* bytes, int pointCount) {
    cc::ControlMesh mesh;
    const int flags = bytes->Byte();
    mesh.scheme = SchemeOf(flags);
    mesh.boundaryRule = static_cast<cc::BoundaryRule>((flags >> 3) % 3);
    mesh.creaseRule = static_cast<cc::CreaseRule>((flags >> 5) & 1);
    mesh.triangleRule = static_cast<cc::TriangleRule>((flags >> 6) & 1);
    mesh.leftHanded = (flags & 128) != 0;
    const int faceCount = bytes->Byte() % 24;
    for (int face = 0; face < faceCount; ++face) {
        const int count = ReadFaceSize(bytes, mesh.scheme);
        mesh.faceVertexCounts.push_back(count);
        for (int i = 0; i < count; ++i) {
            mesh.faceVertexIndices.push_back(bytes->Index(pointCount));
        }
    }
    for (int n = bytes->Byte() % 8; n > 0; --n) {
        const int length = bytes->Index(5);
        mesh.creaseLengths.push_back(length);
        for (int i = 0; i < length; ++i) {
            mesh.creaseIndices.push_back(bytes->Index(pointCount));
        }
        mesh.creaseSharpnesses.push_back(bytes->Float());
    }
    for (int n = bytes->Byte() % 4; n > 0; --n) {
        mesh.cornerIndices.push_back(bytes->Index(pointCount));
        mesh.cornerSharpnesses.push_back(bytes->Float());
    }
    for (int n = bytes->Byte() % 4; n > 0; --n) {
        mesh.holeIndices.push_back(bytes->Index(faceCount));
    }
    return mesh;
}

cc::RayPacket ReadRays(Bytes* bytes) {
    cc::RayPacket rays;
    rays.count = bytes->Byte() % cc::kPacketSize + 1;
    const float x = bytes->Float(), y = bytes->Float(), z = bytes->Float();
    for (int i = 0; i < rays.count; ++i) {
        rays.originX[i] = x;
        rays.originY[i] = y;
        rays.originZ[i] = z;
        rays.directionX[i] = std::sin(0.7f * static_cast<float>(i)) * 0.3f + bytes->Float() - x;
        rays.directionY[i] = std::cos(0.9f * static_cast<float>(i)) * 0.3f - y;
        rays.directionZ[i] = std::sin(1.3f * static_cast<float>(i)) * 0.3f - z;
        rays.tMin[i] = 0;
        rays.tMax[i] = 1e30f;
    }
    return rays;
}

void Require(bool condition) {
    if (!condition) {
        std::abort();
    }
}

void Trace(const cc::InstanceBvh& instances, const cc::RayPacket& rays, int level) {
    cc::TraceStatistics statistics;
    for (const cc::TracerKind kind : {cc::TracerKind::Packet, cc::TracerKind::Single}) {
        const auto tracer = cc::MakeTracer(kind, level);
        cc::RayPacket nearest = rays;
        cc::HitPacket hits;
        tracer->Intersect(instances, &nearest, &hits, &statistics);
        tracer->Occluded(instances, rays, &statistics);
        for (int i = 0; i < rays.count; ++i) {
            if (hits.instance[i] == cc::kNoHit) {
                continue;
            }
            Require(hits.instance[i] < instances.Instances().size());
            const cc::Surface& surface = *instances.Instances()[hits.instance[i]].surface;
            Require(hits.patch[i] < surface.Patches().Count());
            Require(hits.u[i] >= 0 && hits.u[i] <= 1 && hits.v[i] >= 0 && hits.v[i] <= 1);
            Require(!surface.Patches().IsTriangle(hits.patch[i]) || hits.u[i] + hits.v[i] <= 1);
            Require(nearest.tMax[i] >= 0);
            cc::EvaluateLimit(surface.Patches(), hits.patch[i], surface.PatchPoints().data(),
                              hits.u[i], hits.v[i]);
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Bytes bytes(data, size);
    const int pointCount = bytes.Byte() % 32;
    std::vector<cc::Vec3f> points(pointCount);
    for (cc::Vec3f& p : points) {
        p = {bytes.Float(), bytes.Float(), bytes.Float()};
    }
    cc::Scene scene;
    cc::Mesh* mesh = scene.AddMesh("/fuzz");
    mesh->SetTopology(ReadMesh(&bytes, pointCount));
    mesh->SetPoints(points);
    scene.Build({"geometry"});
    const int level = bytes.Byte() % 4;
    Trace(scene.Instances(), ReadRays(&bytes), level);

    // An edit: other points for the same topology.
    for (cc::Vec3f& p : points) {
        p.x += bytes.Float();
    }
    mesh->SetPoints(points);
    scene.Build({"geometry"});
    Trace(scene.Instances(), ReadRays(&bytes), level);
    return 0;
}
