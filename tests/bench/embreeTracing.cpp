#include "embreeTracing.h"

#include <pmmintrin.h>
#include <xmmintrin.h>

#include <cstring>
#include <memory>
#include <stdexcept>

namespace {

/// One thread's tracing of chunks; subclasses lay the rays out as an interface takes them.
class Worker {
  public:
    Worker(RTCScene scene, bool anyHit, bool coherent) : _scene(scene), _anyHit(anyHit) {
        // Embree asks for this, once a thread.
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
        rtcInitIntersectContext(&_context);
        _context.flags =
            coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    }
    virtual ~Worker() = default;

    virtual void Load(const RayChunk& chunk) = 0;
    virtual void Trace() = 0;
    virtual uint64_t CountHits() const = 0;

  protected:
    /// Occlusion queries mark a ray by its far end.
    bool _IsHit(unsigned geometry, float far) const {
        return _anyHit ? far < 0 : geometry != RTC_INVALID_GEOMETRY_ID;
    }

    RTCScene _scene;
    const bool _anyHit;
    RTCIntersectContext _context;
};

/// rtcIntersect1 and rtcIntersect1M: a structure a ray.
class StructureWorker : public Worker {
  public:
    StructureWorker(RTCScene scene, bool anyHit, bool coherent, bool isStream)
        : Worker(scene, anyHit, coherent), _isStream(isStream), _rays(kRaysInChunk) {}

    void Load(const RayChunk& chunk) override {
        _count = chunk.rayCount;
        for (int i = 0; i < _count; ++i) {
            const Ray& from = chunk.rays[i];
            RTCRay& to = _rays[i].ray;
            to = {from.origin.x,
                  from.origin.y,
                  from.origin.z,
                  from.tMin,
                  from.direction.x,
                  from.direction.y,
                  from.direction.z,
                  0,
                  from.tMax,
                  ~0u,
                  0,
                  0};
            _rays[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
            _rays[i].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        }
    }

    void Trace() override {
        if (_isStream && _anyHit) {
            rtcOccluded1M(_scene, &_context, &_rays[0].ray, _count, sizeof(RTCRayHit));
        } else if (_isStream) {
            rtcIntersect1M(_scene, &_context, _rays.data(), _count, sizeof(RTCRayHit));
        } else if (_anyHit) {
            for (int i = 0; i < _count; ++i) {
                rtcOccluded1(_scene, &_context, &_rays[i].ray);
            }
        } else {
            for (int i = 0; i < _count; ++i) {
                rtcIntersect1(_scene, &_context, &_rays[i]);
            }
        }
    }

    uint64_t CountHits() const override {
        uint64_t hits = 0;
        for (int i = 0; i < _count; ++i) {
            hits += _IsHit(_rays[i].hit.geomID, _rays[i].ray.tfar);
        }
        return hits;
    }

  private:
    const bool _isStream;
    int _count = 0;
    std::vector<RTCRayHit> _rays;
};

constexpr int kWidth = 16;

/// rtcIntersect16: rays by sixteens, in the order of the set.
class PacketWorker : public Worker {
  public:
    PacketWorker(RTCScene scene, bool anyHit, bool coherent)
        : Worker(scene, anyHit, coherent), _packets(kRaysInChunk / kWidth) {}

    void Load(const RayChunk& chunk) override {
        _count = (chunk.rayCount + kWidth - 1) / kWidth;
        for (int i = 0; i < _count * kWidth; ++i) {
            RTCRayHit16& to = _packets[i / kWidth].rays;
            const int lane = i % kWidth;
            _packets[i / kWidth].valid[lane] = i < chunk.rayCount ? -1 : 0;
            // Lanes that are left over repeat the last ray, and are masked out.
            const Ray& from = chunk.rays[std::min(i, chunk.rayCount - 1)];
            to.ray.org_x[lane] = from.origin.x;
            to.ray.org_y[lane] = from.origin.y;
            to.ray.org_z[lane] = from.origin.z;
            to.ray.dir_x[lane] = from.direction.x;
            to.ray.dir_y[lane] = from.direction.y;
            to.ray.dir_z[lane] = from.direction.z;
            to.ray.tnear[lane] = from.tMin;
            to.ray.tfar[lane] = from.tMax;
            to.ray.time[lane] = 0;
            to.ray.mask[lane] = ~0u;
            to.ray.flags[lane] = 0;
            to.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
            to.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        }
    }

    void Trace() override {
        for (int i = 0; i < _count; ++i) {
            if (_anyHit) {
                rtcOccluded16(_packets[i].valid, _scene, &_context, &_packets[i].rays.ray);
            } else {
                rtcIntersect16(_packets[i].valid, _scene, &_context, &_packets[i].rays);
            }
        }
    }

    uint64_t CountHits() const override {
        uint64_t hits = 0;
        for (int i = 0; i < _count * kWidth; ++i) {
            const Packet& packet = _packets[i / kWidth];
            const int lane = i % kWidth;
            hits += packet.valid[lane] != 0 &&
                    _IsHit(packet.rays.hit.geomID[lane], packet.rays.ray.tfar[lane]);
        }
        return hits;
    }

  private:
    struct alignas(64) Packet {
        int valid[kWidth];
        RTCRayHit16 rays;
    };
    int _count = 0;
    std::vector<Packet> _packets;
};

/// rtcIntersectNp: an array a component.
class ArrayWorker : public Worker {
  public:
    using Worker::Worker;

    void Load(const RayChunk& chunk) override {
        _count = chunk.rayCount;
        for (int i = 0; i < _count; ++i) {
            const Ray& from = chunk.rays[i];
            const float values[kFloats] = {
                from.origin.x,    from.origin.y,    from.origin.z,    from.tMin,
                from.direction.x, from.direction.y, from.direction.z, 0,
                from.tMax};
            for (int k = 0; k < kFloats; ++k) {
                _floats[k][i] = values[k];
            }
            _mask[i] = ~0u;
            _id[i] = _flags[i] = 0;
            _geometry[i] = _instance[i] = RTC_INVALID_GEOMETRY_ID;
        }
    }

    void Trace() override {
        RTCRayHitNp rays;
        rays.ray = {_floats[0], _floats[1], _floats[2], _floats[3], _floats[4], _floats[5],
                    _floats[6], _floats[7], _floats[8], _mask,      _id,        _flags};
        rays.hit = {_normal[0], _normal[1], _normal[2], _u, _v, _primitive, _geometry, {_instance}};
        if (_anyHit) {
            rtcOccludedNp(_scene, &_context, &rays.ray, _count);
        } else {
            rtcIntersectNp(_scene, &_context, &rays, _count);
        }
    }

    uint64_t CountHits() const override {
        uint64_t hits = 0;
        for (int i = 0; i < _count; ++i) {
            hits += _IsHit(_geometry[i], _floats[8][i]);
        }
        return hits;
    }

  private:
    static constexpr int kFloats = 9;

    int _count = 0;
    alignas(64) float _floats[kFloats][kRaysInChunk];
    alignas(64) float _normal[3][kRaysInChunk], _u[kRaysInChunk], _v[kRaysInChunk];
    alignas(64) unsigned _mask[kRaysInChunk], _id[kRaysInChunk], _flags[kRaysInChunk];
    alignas(64) unsigned _primitive[kRaysInChunk], _geometry[kRaysInChunk], _instance[kRaysInChunk];
};

std::unique_ptr<Worker> MakeWorker(RTCScene scene, const std::string& interface, bool anyHit) {
    const size_t dash = interface.find("-coherent");
    const bool coherent = dash != std::string::npos;
    const std::string base = interface.substr(0, dash);
    if (interface == "1") {
        return std::make_unique<StructureWorker>(scene, anyHit, coherent, false);
    }
    if (base == "1M") {
        return std::make_unique<StructureWorker>(scene, anyHit, coherent, true);
    }
    if (base == "16") {
        return std::make_unique<PacketWorker>(scene, anyHit, coherent);
    }
    if (base == "Np") {
        return std::make_unique<ArrayWorker>(scene, anyHit, coherent);
    }
    throw std::runtime_error("unknown interface '" + interface + "'");
}

}  // namespace

TraceRun TraceWithEmbree(RTCScene scene, const std::string& interface, const RaySet& set,
                         int threads) {
    MakeWorker(scene, interface, set.anyHit);
    return TraceInThreads(set, threads,
                          [&](int) { return MakeWorker(scene, interface, set.anyHit); });
}
