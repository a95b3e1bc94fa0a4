// Measures the renderer on an exported scene, command by command.
//
//     cc_bench SCENE
//
// answers commands from standard input with a line of JSON each, so that tools/bench can let it
// take turns with other programs that trace the same rays:
//
//     build THREADS                      points in memory to the first ray, all anew
//     edit THREADS                       new points to the first ray
//     tessellate LEVEL THREADS           what the tracer "tessellated" needs before it is timed
//     drop-tessellation
//     make-rays FILE SIZE LEVEL          primary, shadow and reflection rays of a square picture
//     load-rays FILE
//     trace TRACER LEVEL SET THREADS     SET is a name such as primary
//     texture TRACER LEVEL SET THREADS   as trace, and texture coordinates at the hits
//     compare TRACER LEVEL SET [LEVEL]   nearest hits that differ from those of packet, at the same
//                                        level or another
//     memory                             what the structures hold
//     draw-levels FILE SIZE TRACER LEVEL VIEW   a picture of levels (levelPicture.h); VIEW is
//     camera
//                                        or above, of the levels for the same camera
//
// The tracers "adaptive" and "adaptive-distance" are "packet" with levels as the camera needs them,
// by error or by distance, up to LEVEL.

#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "builtScene.h"
#include "commands.h"
#include "core/render/renderer.h"
#include "levelPicture.h"
#include "rayMaker.h"
#include "tracing.h"

namespace {

constexpr int kMaxThreads = 1024;

class Bench {
  public:
    explicit Bench(const std::string& path)
        : _source(ReadBenchScene(path)), _firstRay(MakePrimaryRays(_source.camera, 1).rays[0]) {}

    Answer Build(const Words& words) {
        const int threads = NumberAt(words, 0, 1, kMaxThreads);
        _tracers.clear();
        _built = nullptr;
        _built = std::make_unique<BuiltScene>(_source, _firstRay, threads);
        return Answer()
            .Number("seconds", _built->BuildSeconds())
            .Count("peak_rss", PeakResidentBytes());
    }

    Answer Edit(const Words& words) {
        const int threads = NumberAt(words, 0, 1, kMaxThreads);
        _RequireScene();
        std::vector<std::vector<cc::Vec3f>> points;
        ++_edits;
        _tracers.clear();
        for (const BenchMesh& mesh : _source.meshes) {
            points.push_back(RippledPoints(mesh, static_cast<float>(_edits)));
        }
        return Answer().Number("seconds", _built->Edit(std::move(points), _firstRay, threads));
    }

    Answer Tessellate(const Words& words) {
        const int level = NumberAt(words, 0, 0, 8), threads = NumberAt(words, 1, 1, kMaxThreads);
        _RequireScene();
        return Answer().Number("seconds", _built->Tessellate(level, threads));
    }

    Answer DropTessellation() {
        _RequireScene();
        _built->DropTessellation();
        return Answer();
    }

    Answer MakeRays(const Words& words) {
        const std::string& path = WordAt(words, 0);
        const int size = NumberAt(words, 1, 8, 16384), level = NumberAt(words, 2, 0, 8);
        _RequireScene();
        std::vector<RaySet> sets{MakePrimaryRays(_source.camera, size)};
        const auto tracer = MakeTracer(cc::TracerKind::Packet, level);
        for (RaySet& set : MakeSecondaryRays(_built->Scene(), _source.lights, sets[0], *tracer)) {
            sets.push_back(std::move(set));
        }
        WriteRays(path, sets);
        Answer answer;
        for (const RaySet& set : sets) {
            answer.Count(set.name, set.rays.size());
        }
        return answer;
    }

    Answer LoadRays(const Words& words) {
        _tracers.clear();
        _sets = ReadRays(WordAt(words, 0));
        return Answer().Count("sets", _sets.size());
    }

    Answer Trace(const Words& words, HitValues values) {
        const std::string& tracer = WordAt(words, 0);
        const int level = NumberAt(words, 1, 0, 8), threads = NumberAt(words, 3, 1, kMaxThreads);
        _RequireScene();
        cc::TraceStatistics s;
        const TraceRun run = TraceRays(_built->Scene(), _TracerFor(tracer, level),
                                       _SetOfName(WordAt(words, 2)), threads, values, &s);
        return Answer()
            .Number("seconds", run.seconds)
            .Number("wall_seconds", run.wallSeconds)
            .Count("rays", run.rays)
            .Count("hits", run.hits)
            .Count("packets", s.packets)
            .Count("traversals", s.traversals)
            .Count("leaf_intersections", s.leafIntersections)
            .Count("subdivisions_regular", s.subdivisionsRegular)
            .Count("subdivisions_irregular", s.subdivisionsIrregular)
            .Count("box_tests", s.boxTests)
            .Count("early_hit", s.earlyHits)
            .Count("interval_culls", s.intervalCulls)
            .Count("final_intersections", s.finalIntersections)
            .Count("active_lanes", s.activeLanes);
    }

    Answer Compare(const Words& words) {
        const std::string& tracer = WordAt(words, 0);
        const int level = NumberAt(words, 1, 0, 8);
        const int reference = words.size() > 3 ? NumberAt(words, 3, 0, 8) : level;
        _RequireScene();
        const RaySet& set = _SetOfName(WordAt(words, 2));
        const double size = std::sqrt(static_cast<double>(set.rays.size()));
        cc::Camera camera = _source.camera;
        MakeSquare(&camera);
        const double pixels = size / (camera.windowUpper.x - camera.windowLower.x);
        const HitDifferences found = CompareHits(_built->Scene(), _TracerFor("packet", reference),
                                                 _TracerFor(tracer, level), set, pixels);
        return Answer()
            .Count("hits", found.hits)
            .Count("distances", found.distances)
            .Number("picture", found.picture)
            .Number("error_pixels", found.error);
    }

    Answer DrawLevels(const Words& words) const {
        const int size = NumberAt(words, 1, 8, 16384), level = NumberAt(words, 3, 0, 8);
        const std::string& view = WordAt(words, 4);
        if (view != "camera" && view != "above") {
            throw std::runtime_error("there is no view '" + view + "'");
        }
        _RequireScene();
        cc::Camera camera = _source.camera;
        MakeSquare(&camera);
        const cc::LevelMetric levels = _AdaptiveLevels(WordAt(words, 2), level, size);
        if (view == "above") {
            camera = CameraFromAbove(_built->Scene().Instances().Bounds());
        }
        WriteLevelPicture(_built->Scene(), levels, camera, size, WordAt(words, 0));
        return Answer();
    }

    Answer Memory() const {
        _RequireScene();
        const cc::Scene::Statistics statistics = _built->Scene().GetStatistics();
        size_t patches = 0, points = 0, bvh = _built->Scene().Instances().Bytes();
        for (const cc::Instance& instance : _built->Scene().Instances().Instances()) {
            patches += cc::SurfaceOf(instance).Patches().Bytes();
            points += cc::SurfaceOf(instance).PatchPoints().capacity() * sizeof(cc::Vec3f);
            bvh += instance.geometry->PrimitiveBvh().Bytes();
        }
        return Answer()
            .Count("faces", statistics.faces)
            .Count("patches", statistics.patches)
            .Count("bytes", statistics.bytes - statistics.tessellationBytes)
            .Count("tessellation_bytes", statistics.tessellationBytes)
            .Count("patch_bytes", patches)
            .Count("point_bytes", points)
            .Count("bvh_bytes", bvh)
            .Count("peak_rss", PeakResidentBytes());
    }

  private:
    void _RequireScene() const {
        if (!_built) {
            throw std::runtime_error("nothing is built yet");
        }
    }

    const cc::Tracer& _TracerFor(const std::string& name, int level) {
        std::unique_ptr<cc::Tracer>& tracer = _tracers[{name, level}];
        if (!tracer && (name == "adaptive" || name == "adaptive-distance")) {
            const auto pixels = static_cast<double>(_SetOfName("primary").rays.size());
            const int size = static_cast<int>(std::lround(std::sqrt(pixels)));
            tracer = MakeTracer(cc::TracerKind::Packet, _AdaptiveLevels(name, level, size));
        } else if (!tracer) {
            tracer = MakeTracer(TracerKindOfName(name), level);
        }
        return *tracer;
    }

    /// The levels of a square picture: by error, or by distance, where the finest ends after an
    /// eighth of the scene's diameter.
    cc::LevelMetric _AdaptiveLevels(const std::string& name, int finest, int size) const {
        cc::Camera camera = _source.camera;
        MakeSquare(&camera);
        cc::RenderOptions options;
        options.level = finest;
        options.alpha = name == "adaptive" ? 0 : std::ldexp(1.0f, finest - 3);
        return MakeLevelMetric(_built->Scene(), camera, size, size, options);
    }

    const RaySet& _SetOfName(const std::string& name) const {
        for (const RaySet& set : _sets) {
            if (set.name == name) {
                return set;
            }
        }
        throw std::runtime_error("there are no rays '" + name + "'");
    }

    const BenchScene _source;
    const Ray _firstRay;
    int _edits = 0;
    std::unique_ptr<BuiltScene> _built;
    std::map<std::pair<std::string, int>, std::unique_ptr<cc::Tracer>> _tracers;
    std::vector<RaySet> _sets;
};

void Serve(const std::string& path) {
    Bench bench(path);
    ServeCommands({
        {"build", [&](const Words& words) { return bench.Build(words); }},
        {"edit", [&](const Words& words) { return bench.Edit(words); }},
        {"tessellate", [&](const Words& words) { return bench.Tessellate(words); }},
        {"drop-tessellation", [&](const Words&) { return bench.DropTessellation(); }},
        {"make-rays", [&](const Words& words) { return bench.MakeRays(words); }},
        {"load-rays", [&](const Words& words) { return bench.LoadRays(words); }},
        {"trace", [&](const Words& words) { return bench.Trace(words, HitValues::None); }},
        {"texture",
         [&](const Words& words) { return bench.Trace(words, HitValues::TextureCoordinates); }},
        {"compare", [&](const Words& words) { return bench.Compare(words); }},
        {"draw-levels", [&](const Words& words) { return bench.DrawLevels(words); }},
        {"memory", [&](const Words&) { return bench.Memory(); }},
    });
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc != 2) {
            throw std::runtime_error("usage: cc_bench SCENE");
        }
        Serve(argv[1]);
        return 0;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "error: %s\n", failure.what());
        return 1;
    }
}
