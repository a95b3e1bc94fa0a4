#include "tests/watertight/watertight.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>

#include <tbb/parallel_for.h>

#include "core/subdiv/limitPoint.h"
#include "core/trace/instance.h"
#include "tests/unit/trace/traceKit.h"
#include "tests/watertight/enclosedPoints.h"

namespace cc::test {
namespace {

/// Levels from this on have nearly the same inside; that of others is looked at.
constexpr int kInsideLevel = 2;
/// Some sixteen steps of a float's last bit.
constexpr float kRounding = 2e-6f;

/// A closed cage put somewhere.
class PlacedCage {
  public:
    PlacedCage(const Cage& cage, const Placement& placement) : _placement(placement) {
        const float scale = placement.scale, offset = placement.offset;
        std::vector<Vec3f> points = cage.points;
        Instance instance;
        if (placement.byTransform) {
            instance.objectToWorld = AffineTransform(
                {{{scale, 0, 0, offset}, {0, scale, 0, offset}, {0, 0, scale, offset}}});
            instance.objectToWorld.Invert(&instance.worldToObject);
        }
        for (Vec3f& p : points) {
            p = Place(p);
        }
        _surface = std::make_unique<Surface>(cage.mesh, points);
        instance.geometry = _surface.get();
        _world = InstanceBvh({instance});
        const Box3f bounds = _world.Bounds();
        for (int axis = 0; axis < 3; ++axis) {
            _rounding =
                std::max({_rounding, std::fabs(bounds.lower[axis]), std::fabs(bounds.upper[axis])});
        }
        _rounding *= kRounding / (placement.byTransform ? scale : 1);
    }

    const InstanceBvh& World() const { return _world; }
    const Surface& GetSurface() const { return *_surface; }
    Vec3f ToWorld(const Vec3f& p) const { return _world.Instances()[0].objectToWorld.Point(p); }
    /// The surface, cut as the world knows it.
    CutSurface Cut(const LevelMetric& metric) const {
        return {*_surface, InstanceLevels(metric, _world.Instances()[0])};
    }
    /// How far points of the world may be rounded, in the surface's space: a ray must hit that
    /// passes a point which is enclosed by so much.
    float Rounding() const { return _rounding; }
    /// Where a point of the cage, as it was before it was placed, is in the surface's space.
    Vec3f Place(const Vec3f& p) const {
        const float offset = _placement.offset;
        return _placement.byTransform ? p : _placement.scale * p + Vec3f{offset, offset, offset};
    }

  private:
    const Placement _placement;
    std::unique_ptr<Surface> _surface;
    InstanceBvh _world;
    float _rounding = 0;
};

/// Points of a surface that rays like to slip through at.
class Targets {
  public:
    Targets(const PlacedCage& cage, int level, std::mt19937* random)
        : _cage(cage), _quads(1 << level), _random(*random) {}

    enum Kind { kVertices, kEdges, kGridVertices, kGridEdges, kAnywhere, kKindCount };

    /// Mostly one that was picked before, since to evaluate one takes longer than to trace a ray.
    Vec3f Pick(Kind kind) {
        std::vector<Vec3f>& picked = _picked[kind];
        if (picked.empty() || _random() % kPicksOfEach == 0) {
            picked.push_back(_Evaluate(kind));
        }
        return picked[_random() % picked.size()];
    }

  private:
    static constexpr unsigned kPicksOfEach = 12;

    Vec3f _Evaluate(Kind kind) {
        const Surface& surface = _cage.GetSurface();
        const auto count = static_cast<uint32_t>(surface.Patches().Count());
        const uint32_t patch = std::uniform_int_distribution<uint32_t>(0, count - 1)(_random);
        float u = _Unit(), v = _Unit();
        if (kind == kVertices || kind == kEdges) {
            v = std::round(v);
        }
        if (kind == kVertices) {
            u = std::round(u);
        }
        if (kind == kGridVertices || kind == kGridEdges) {
            v = std::round(v * _quads) / _quads;
        }
        if (kind == kGridVertices) {
            u = std::round(u * _quads) / _quads;
        }
        if (_random() % 2 != 0) {
            std::swap(u, v);
        }
        if (surface.Patches().IsTriangle(patch) && u + v > 1) {
            u = 1 - u;
            v = kind == kEdges && _random() % 2 == 0 ? 1 - u : 1 - v;  // the third edge, too
        }
        return _cage.ToWorld(
            EvaluateLimit(surface.Patches(), patch, surface.PatchPoints().data(), u, v).position);
    }

    float _Unit() { return std::uniform_real_distribution<float>(0, 1)(_random); }

    const PlacedCage& _cage;
    const float _quads;
    std::mt19937& _random;
    std::vector<Vec3f> _picked[kKindCount];
};

/// A packet of rays from a point inside, or through it from outside.
RayPacket MakePacket(const Vec3f& inside, Targets::Kind kind, bool isAcross, Targets* targets,
                     std::mt19937* random) {
    RayPacket rays;
    rays.count = kPacketSize;
    for (int i = 0; i < kPacketSize; ++i) {
        Vec3f direction{};
        while (Dot(direction, direction) == 0) {
            direction = targets->Pick(kind) - inside;
            if (kind == Targets::kAnywhere) {
                std::normal_distribution<float> normal;
                direction =
                    Length(direction) * Vec3f{normal(*random), normal(*random), normal(*random)};
            }
        }
        Vec3f origin = inside;
        if (isAcross) {
            origin = inside + 3.0f * direction;
            direction = inside - origin;
        }
        SetRay(i, origin, direction, &rays);
    }
    return rays;
}

/// A bit for each ray that hits nothing.
uint64_t Escapes(const Tracer& tracer, const PlacedCage& cage, RayPacket rays, bool anyHit,
                 SharedGrids* grids) {
    TraceStatistics statistics;
    if (anyHit) {
        return ~tracer.Occluded(cage.World(), rays, &statistics, grids);
    }
    HitPacket hits;
    tracer.Intersect(cage.World(), &rays, &hits, &statistics, grids);
    uint64_t escapes = 0;
    for (int i = 0; i < rays.count; ++i) {
        escapes |= uint64_t(hits.instance[i] == kNoHit) << i;
    }
    return escapes;
}

std::string Describe(const Cage& cage, const RayPacket& rays, int i, const char* query) {
    char text[512];
    std::snprintf(text, sizeof(text), "%s, %s: from %.9g %.9g %.9g along %.9g %.9g %.9g",
                  cage.name.c_str(), query, rays.originX[i], rays.originY[i], rays.originZ[i],
                  rays.directionX[i], rays.directionY[i], rays.directionZ[i]);
    return text;
}

/// Points inside a placed cage at one level, or at all up to that.
/// @param candidates  points of the cage before it was placed
std::vector<Vec3f> PlacedPoints(const PlacedCage& cage, const std::vector<Vec3f>& candidates,
                                int level, bool isAdaptive) {
    std::vector<CutSurface> cuts;
    for (int least = isAdaptive ? 0 : level; least <= level && least < kInsideLevel; ++least) {
        cuts.push_back(cage.Cut(least));
    }
    std::vector<Vec3f> placed;
    for (const Vec3f& candidate : candidates) {
        const Vec3f point = cage.Place(candidate);
        if (std::all_of(cuts.begin(), cuts.end(), [&](const CutSurface& cut) {
                return cut.Encloses(point, cage.Rounding());
            })) {
            placed.push_back(point);
        }
    }
    return placed;
}

/// How finely a cage is cut: all over, or as a camera says that changes now and then.
class ChangingLevels {
  public:
    ChangingLevels(const PlacedCage& cage, const WatertightCount& count, std::mt19937* random)
        : _cage(cage), _count(count), _random(*random), _metric(count.level) {}

    /// Returns true if the levels of what comes next differ from those before.
    bool Change(uint64_t packet) {
        if (_count.isAdaptive && packet % kPacketsOfEach == 0) {
            _metric = _Random();
            return true;
        }
        return packet == 0;
    }
    const LevelMetric& Metric() const { return _metric; }

  private:
    static constexpr uint64_t kPacketsOfEach = 8;

    /// Levels fall off from the finest, at the surface's point nearest to the eye, to where they
    /// are none.
    LevelMetric _Random() {
        const Surface& surface = _cage.GetSurface();
        std::uniform_real_distribution<float> unit(0, 1);
        const Box3f bounds = _cage.World().Bounds();
        const float away = bounds.Diagonal() * std::exp2(-10 * unit(_random));
        const auto patch = static_cast<uint32_t>(_random() % surface.Patches().Count());
        const Vec3f on = _cage.ToWorld(
            EvaluateLimitValue(surface.Patches(), patch, surface.PatchPoints().data(), 0, 0));
        LevelView view{};
        Vec3f forward{};
        while (Length(forward) < 0.1f) {
            forward = {unit(_random) - 0.5f, unit(_random) - 0.5f, unit(_random) - 0.5f};
        }
        view.forward = Normalize(forward);
        for (int axis = 0; axis < 3; ++axis) {
            view.eye[axis] = static_cast<double>(on[axis]) - away * view.forward[axis];
        }
        view.pixels = 1;
        view.isOrthographic = false;
        view.leastCosine = 0.3f + 0.7f * unit(_random);
        if (_random() % 2 == 0) {
            // Fine ends somewhere between the surface's nearest point and its furthest.
            const float end = away * std::pow(bounds.Diagonal() / away, unit(_random));
            return DistanceMetric{view.eye, std::ldexp(end, _count.level), _count.level};
        }
        const float size = bounds.Diagonal() / std::max(surface.Bounds().Diagonal(), 1e-30f);
        const float error = surface.Errors().Largest() * size / away;
        return PixelErrorMetric{
            view, error * std::exp2(-2.0f * static_cast<float>(_count.level) * unit(_random)),
            _count.level};
    }

    const PlacedCage& _cage;
    const WatertightCount& _count;
    std::mt19937& _random;
    LevelMetric _metric;
};

/// Traces a cage with one tracer at one level, or levels up to that.
void CountInCage(const Cage& source, const PlacedCage& cage, const std::vector<Vec3f>& inside,
                 uint64_t packets, std::mt19937* random, WatertightCount* count) {
    std::unique_ptr<Tracer> tracer;
    ChangingLevels levels(cage, *count, random);
    Targets targets(cage, count->level, random);
    SharedGrids grids;
    for (uint64_t n = 0; n < packets && !inside.empty(); ++n) {
        if (levels.Change(n)) {
            tracer = MakeTracer(count->tracer, levels.Metric());
            grids.Clear();
        }
        const Vec3f& point = inside[n % inside.size()];
        const auto kind = static_cast<Targets::Kind>(n % Targets::kKindCount);
        const bool isAcross = (*random)() % 4 == 0, anyHit = (*random)() % 2 == 0;
        const RayPacket rays = MakePacket(cage.ToWorld(point), kind, isAcross, &targets, random);
        const uint64_t escapes = Escapes(*tracer, cage, rays, anyHit, &grids);
        count->rays += static_cast<uint64_t>(rays.count);
        // Level by level the inside is a little different: what counts is that of these.
        if (escapes != 0 && cage.Cut(levels.Metric()).Encloses(point, cage.Rounding())) {
            count->escapes += static_cast<uint64_t>(__builtin_popcountll(escapes));
            if (count->firstEscape.empty()) {
                count->firstEscape = Describe(source, rays, __builtin_ctzll(escapes),
                                              anyHit ? "any hit" : "nearest hit");
            }
        }
    }
}

/// How many packets each cage gets. Triangles of the Loop scheme take ten times as long.
class PacketShare {
  public:
    PacketShare(const std::vector<Cage>& cages, uint64_t rays) {
        double weights = 0;
        for (const Cage& cage : cages) {
            weights += _Weight(cage);
        }
        _packets = static_cast<double>(rays) / (kPacketSize * std::max(weights, 1.0));
    }
    uint64_t Of(const Cage& cage) const {
        return static_cast<uint64_t>(std::ceil(_packets * _Weight(cage)));
    }

  private:
    static double _Weight(const Cage& cage) { return cage.mesh.scheme == Scheme::Loop ? 0.1 : 1; }

    double _packets;
};

void Add(const WatertightCount& from, WatertightCount* to) {
    to->rays += from.rays;
    to->escapes += from.escapes;
    if (to->firstEscape.empty()) {
        to->firstEscape = from.firstEscape;
    }
}

/// Some points well inside a cage.
std::vector<Vec3f> PointsInside(const Cage& cage, std::mt19937* random) {
    const Surface surface(cage.mesh, cage.points);
    Instance instance;
    instance.geometry = &surface;
    return EnclosedPoints(surface, InstanceLevels(kInsideLevel, instance), 3, random);
}

}  // namespace

const std::vector<Placement>& AllPlacements() {
    static const std::vector<Placement> kAll{
        {"as it is", 1, 0, false},
        {"1e-4 in size", 1e-4f, 0, false},
        {"1e5 in size", 1e5f, 0, false},
        {"100 in size, 1e5 away", 100, 1e5f, false},
        {"1 in size, 1e5 away", 1, 1e5f, false},
        {"1e-4 in size by transform", 1e-4f, 0, true},
        {"1e5 in size, 1e5 away by transform", 1e5f, 1e5f, true},
        {"1 in size, 1e5 away by transform", 1, 1e5f, true},
    };
    return kAll;
}

std::vector<WatertightCount> CountEscapes(const std::vector<Cage>& closedCages,
                                          const WatertightOptions& options) {
    const std::vector<Placement>& placements =
        options.placements.empty() ? AllPlacements() : options.placements;
    std::vector<WatertightCount> counts;
    for (const Placement& placement : placements) {
        for (const int level : options.levels) {
            for (const TracerKind tracer : options.tracers) {
                counts.push_back({level, options.isAdaptive, tracer, placement.name, 0, 0, {}});
            }
        }
    }
    const PacketShare share(closedCages, options.rays / std::max<size_t>(counts.size(), 1));
    std::vector<std::vector<WatertightCount>> ofCages(closedCages.size(), counts);
    tbb::parallel_for(size_t(0), closedCages.size(), [&](size_t c) {
        const Cage& source = closedCages[c];
        std::mt19937 random(options.seed * 1'000'003u + static_cast<uint32_t>(c));
        const std::vector<Vec3f> candidates = PointsInside(source, &random);
        WatertightCount* count = ofCages[c].data();
        for (const Placement& placement : placements) {
            const PlacedCage cage(source, placement);
            for (const int level : options.levels) {
                const std::vector<Vec3f> inside =
                    PlacedPoints(cage, candidates, level, options.isAdaptive);
                for (size_t i = 0; i < options.tracers.size(); ++i) {
                    CountInCage(source, cage, inside, share.Of(source), &random, count++);
                }
            }
        }
    });
    for (const std::vector<WatertightCount>& ofCage : ofCages) {
        for (size_t k = 0; k < counts.size(); ++k) {
            Add(ofCage[k], &counts[k]);
        }
    }
    return counts;
}

}  // namespace cc::test
