#include "primaryRays.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace {

constexpr int kTile = 8;

/// Makes the rays of a tile of pixels. Distances are measured along the view axis.
class TileRays {
  public:
    TileRays(const cc::Camera& camera, int width, int height)
        : _camera(camera), _width(width), _height(height) {}

    int TilesX() const { return (_width + kTile - 1) / kTile; }
    int TileCount() const { return TilesX() * ((_height + kTile - 1) / kTile); }

    void Fill(int tile, cc::RayPacket* rays) const {
        const int x0 = tile % TilesX() * kTile, y0 = tile / TilesX() * kTile;
        rays->count = 0;
        for (int y = y0; y < std::min(y0 + kTile, _height); ++y) {
            for (int x = x0; x < std::min(x0 + kTile, _width); ++x) {
                _Add(x, y, rays);
            }
        }
    }

  private:
    void _Add(int x, int y, cc::RayPacket* rays) const {
        const cc::Vec2f lower = _camera.windowLower, upper = _camera.windowUpper;
        const float wx = lower.x + (upper.x - lower.x) * (x + 0.5f) / _width;
        const float wy = lower.y + (upper.y - lower.y) * (y + 0.5f) / _height;
        const cc::Vec3f inWindow{wx, wy, 0}, along{0, 0, -1};
        const bool isFlat = _camera.orthographic;
        const cc::Vec3f origin = _camera.cameraToWorld.Point(isFlat ? inWindow : cc::Vec3f{});
        const cc::Vec3f direction =
            _camera.cameraToWorld.Direction(isFlat ? along : inWindow + along);

        const int i = rays->count++;
        rays->originX[i] = origin.x;
        rays->originY[i] = origin.y;
        rays->originZ[i] = origin.z;
        rays->directionX[i] = direction.x;
        rays->directionY[i] = direction.y;
        rays->directionZ[i] = direction.z;
        rays->tMin[i] = _camera.clipNear;
        rays->tMax[i] = _camera.clipFar;
    }

    const cc::Camera& _camera;
    int _width, _height;
};

/// One thread's share: tiles are taken off a common counter. Only the tracer is timed.
PrimaryRun TraceTiles(const cc::Scene& scene, const cc::Tracer& tracer, const TileRays& tiles,
                      std::atomic<int>* nextTile) {
    using Clock = std::chrono::steady_clock;
    PrimaryRun run;
    cc::RayPacket rays;
    cc::HitPacket hits;
    Clock::duration spent{0};
    for (int tile; (tile = (*nextTile)++) < tiles.TileCount();) {
        tiles.Fill(tile, &rays);
        const Clock::time_point begin = Clock::now();
        tracer.Intersect(scene.Instances(), &rays, &hits, &run.statistics);
        spent += Clock::now() - begin;
        run.rays += rays.count;
        for (int i = 0; i < rays.count; ++i) {
            run.hits += hits.instance[i] != cc::kNoHit;
        }
    }
    run.seconds = std::chrono::duration<double>(spent).count();
    return run;
}

}  // namespace

PrimaryRun TracePrimaryRays(const cc::Scene& scene, const cc::Camera& camera,
                            const cc::Tracer& tracer, int width, int height, int threads) {
    const TileRays tiles(camera, width, height);
    std::atomic<int> nextTile{0};
    std::vector<PrimaryRun> shares(threads);
    std::vector<std::thread> workers;
    for (PrimaryRun& share : shares) {
        workers.emplace_back([&] { share = TraceTiles(scene, tracer, tiles, &nextTile); });
    }
    PrimaryRun all;
    for (int i = 0; i < threads; ++i) {
        workers[i].join();
        all.seconds += shares[i].seconds / threads;
        all.rays += shares[i].rays;
        all.hits += shares[i].hits;
        all.statistics += shares[i].statistics;
    }
    return all;
}
