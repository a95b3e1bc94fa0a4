// Traces the rays that cc_bench traces, with Embree, command by command.
//
//     cc_embree SCENE subdivision|grid|quad LEVEL
//
// answers commands from standard input with a line of JSON each:
//
//     build THREADS                   points in memory to the first ray, all anew
//     edit                            new points to the first ray
//     load-rays FILE
//     trace INTERFACE SET THREADS     INTERFACE as in embreeTracing.h
//     memory                          what Embree holds

#include <cstdio>
#include <exception>
#include <map>
#include <stdexcept>

#include "commands.h"
#include "embreeScene.h"
#include "embreeTracing.h"
#include "rays.h"

namespace {

const std::map<std::string, EmbreeMode> kModes{
    {"subdivision", EmbreeMode::Subdivision},
    {"grid", EmbreeMode::Grid},
    {"quad", EmbreeMode::Quad},
};

Answer Timed(const EmbreeScene::Seconds& seconds) {
    return Answer()
        .Number("seconds", seconds.commit)
        .Number("tessellation_seconds", seconds.tessellation)
        .Count("peak_rss", PeakResidentBytes());
}

Answer Trace(const EmbreeScene& scene, const std::vector<RaySet>& sets, const Words& words) {
    for (const RaySet& set : sets) {
        if (set.name == WordAt(words, 1)) {
            const TraceRun run =
                TraceWithEmbree(scene.Handle(), WordAt(words, 0), set, NumberAt(words, 2, 1, 1024));
            return Answer()
                .Number("seconds", run.seconds)
                .Number("wall_seconds", run.wallSeconds)
                .Count("rays", run.rays)
                .Count("hits", run.hits);
        }
    }
    throw std::runtime_error("there are no rays '" + WordAt(words, 1) + "'");
}

void Serve(const Words& words) {
    const auto mode = kModes.find(WordAt(words, 1));
    if (mode == kModes.end()) {
        throw std::runtime_error("unknown mode '" + words[1] + "'");
    }
    EmbreeScene scene(ReadBenchScene(WordAt(words, 0)), mode->second, NumberAt(words, 2, 0, 8));
    std::vector<RaySet> sets;
    int edits = 0;
    ServeCommands({
        {"build", [&](const Words& w) { return Timed(scene.Build(NumberAt(w, 0, 1, 1024))); }},
        {"edit", [&](const Words&) { return Timed(scene.Edit(static_cast<float>(++edits))); }},
        {"load-rays",
         [&](const Words& w) {
             sets = ReadRays(WordAt(w, 0));
             return Answer().Count("sets", sets.size());
         }},
        {"trace", [&](const Words& w) { return Trace(scene, sets, w); }},
        {"memory",
         [&](const Words&) {
             return Answer()
                 .Text("about", scene.Description())
                 .Count("faces", scene.FaceCount())
                 .Count("bytes", scene.Bytes())
                 .Count("peak_bytes", scene.PeakBytes())
                 .Count("peak_rss", PeakResidentBytes());
         }},
    });
}

}  // namespace

int main(int argc, char** argv) {
    try {
        Serve(Words(argv + 1, argv + argc));
        return 0;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "error: %s\n", failure.what());
        return 1;
    }
}
