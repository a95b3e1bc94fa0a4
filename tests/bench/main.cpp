// Measures how fast primary rays are traced through an exported scene; prints JSON.
//
//     cc_bench SCENE [--level L] [--threads N] [--size PIXELS] [--runs N] --tracer NAME...
//
// Tracers take turns, run by run, over the same rays; tools/bench takes the medians.

#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchScene.h"
#include "core/trace/tracer.h"
#include "primaryRays.h"

namespace {

struct Options {
    std::string scene;
    std::vector<std::string> tracers;
    int level = 4, threads = 1, size = 1024, runs = 5;
};

const std::map<std::string, cc::TracerKind> kTracers{
    {"packet", cc::TracerKind::Packet},
    {"single", cc::TracerKind::Single},
};

int ToInt(const std::string& name, const std::string& text, int lowest, int highest) {
    char* end = nullptr;
    const long value = std::strtol(text.c_str(), &end, 10);
    if (text.empty() || *end != '\0' || value < lowest || value > highest) {
        throw std::runtime_error(name + " must be a number from " + std::to_string(lowest) +
                                 " to " + std::to_string(highest));
    }
    return static_cast<int>(value);
}

void SetOption(const std::string& name, const std::string& value, Options* options) {
    if (name == "--level") {
        options->level = ToInt(name, value, 0, 8);
    } else if (name == "--threads") {
        options->threads = ToInt(name, value, 1, 1024);
    } else if (name == "--size") {
        options->size = ToInt(name, value, 8, 16384);
    } else if (name == "--runs") {
        options->runs = ToInt(name, value, 1, 1000);
    } else if (name == "--tracer" && kTracers.count(value) != 0) {
        options->tracers.push_back(value);
    } else {
        throw std::runtime_error("unknown option " + name + " " + value);
    }
}

Options ParseOptions(int argc, char** argv) {
    Options options;
    if (argc < 2) {
        throw std::runtime_error("a scene is needed");
    }
    options.scene = argv[1];
    for (int i = 2; i < argc; i += 2) {
        SetOption(argv[i], i + 1 < argc ? argv[i + 1] : "", &options);
    }
    if (options.tracers.empty()) {
        throw std::runtime_error("a --tracer is needed");
    }
    return options;
}

/// Builds the meshes as Hydra would hand them over. Returns the camera to look through.
cc::Camera BuildScene(const std::string& path, cc::Scene* scene) {
    BenchScene source;
    const std::string error = ReadBenchScene(path, &source);
    if (!error.empty()) {
        throw std::runtime_error(error);
    }
    for (BenchMesh& mesh : source.meshes) {
        cc::Mesh* added = scene->AddMesh(mesh.name);
        added->SetTopology(std::move(mesh.topology));
        added->SetPoints(std::move(mesh.points));
        added->SetTransform(mesh.objectToWorld);
        added->SetRenderTag("geometry");
    }
    for (const std::string& warning : scene->Build({"geometry"})) {
        std::fprintf(stderr, "warning: %s\n", warning.c_str());
    }
    return source.camera;
}

void PrintRun(const std::string& tracer, const PrimaryRun& run, bool isLast) {
    const cc::TraceStatistics& s = run.statistics;
    const auto count = [](const char* name, uint64_t value) {
        std::printf(", \"%s\": %llu", name, static_cast<unsigned long long>(value));
    };
    std::printf("    {\"tracer\": \"%s\", \"seconds\": %.9g", tracer.c_str(), run.seconds);
    count("rays", run.rays);
    count("hits", run.hits);
    count("packets", s.packets);
    count("traversals", s.traversals);
    count("leaf_intersections", s.leafIntersections);
    count("subdivisions_regular", s.subdivisionsRegular);
    count("subdivisions_irregular", s.subdivisionsIrregular);
    count("box_tests", s.boxTests);
    count("early_hit", s.earlyHits);
    count("interval_culls", s.intervalCulls);
    count("final_intersections", s.finalIntersections);
    count("active_lanes", s.activeLanes);
    std::printf("}%s\n", isLast ? "" : ",");
}

void PrintScene(const cc::Scene::Statistics& statistics) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("  \"faces\": %zu,\n  \"patches\": %zu,\n  \"bytes\": %zu,\n", statistics.faces,
                statistics.patches, statistics.bytes);
    std::printf("  \"build_seconds\": %.9g,\n  \"peak_rss\": %ld,\n", statistics.buildSeconds,
                usage.ru_maxrss * 1024L);
}

void Measure(const Options& options) {
    cc::Scene scene;
    const cc::Camera camera = BuildScene(options.scene, &scene);
    std::map<std::string, std::unique_ptr<cc::Tracer>> tracers;
    for (const std::string& name : options.tracers) {
        tracers[name] = cc::MakeTracer(kTracers.at(name), options.level);
    }
    std::printf("{\n  \"runs\": [\n");
    for (int run = 0; run < options.runs; ++run) {
        for (const std::string& name : options.tracers) {
            const bool isLast = run + 1 == options.runs && name == options.tracers.back();
            PrintRun(name,
                     TracePrimaryRays(scene, camera, *tracers[name], options.size, options.size,
                                      options.threads),
                     isLast);
        }
    }
    std::printf("  ],\n");
    PrintScene(scene.GetStatistics());
    std::printf("  \"level\": %d,\n  \"threads\": %d\n}\n", options.level, options.threads);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        Measure(ParseOptions(argc, argv));
        return 0;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "error: %s\n", failure.what());
        return 1;
    }
}
