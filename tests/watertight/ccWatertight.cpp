// Counts rays that slip through closed surfaces.
//
//     cc_watertight
//
// answers commands from standard input with a line of JSON each:
//
//     count TRACER PLACEMENT LEVEL RAYS SEED THREADS ADAPTIVE
//
// PLACEMENT is an index; an error beyond the last. ADAPTIVE is 1 for levels up to LEVEL, else 0.

#include <map>
#include <stdexcept>

#include <tbb/task_arena.h>

#include "tests/bench/commands.h"
#include "tests/watertight/closedCages.h"
#include "tests/watertight/watertight.h"

namespace {

using cc::test::WatertightCount;
using cc::test::WatertightOptions;

const std::map<std::string, cc::TracerKind> kTracers{
    {"packet", cc::TracerKind::Packet},
    {"single", cc::TracerKind::Single},
    {"algorithm1", cc::TracerKind::Algorithm1},
    {"tessellated", cc::TracerKind::Tessellated},
};

Answer Count(const std::vector<cc::test::Cage>& cages, const Words& words) {
    const auto tracer = kTracers.find(WordAt(words, 0));
    if (tracer == kTracers.end()) {
        throw std::runtime_error("unknown tracer '" + words[0] + "'");
    }
    const auto& placements = cc::test::AllPlacements();
    WatertightOptions options;
    options.tracers = {tracer->second};
    options.placements = {
        placements[NumberAt(words, 1, 0, static_cast<int>(placements.size()) - 1)]};
    options.levels = {NumberAt(words, 2, 0, 8)};
    options.rays = static_cast<uint64_t>(NumberAt(words, 3, 1, 2'000'000'000));
    options.seed = static_cast<uint32_t>(NumberAt(words, 4, 0, 1'000'000));
    options.isAdaptive = NumberAt(words, 6, 0, 1) == 1;
    tbb::task_arena arena(NumberAt(words, 5, 1, 1024));
    const WatertightCount count =
        arena.execute([&] { return CountEscapes(cages, options).front(); });
    return Answer()
        .Text("placement", count.placement)
        .Count("cages", cages.size())
        .Count("rays", count.rays)
        .Count("escapes", count.escapes)
        .Text("first_escape", count.firstEscape);
}

}  // namespace

int main() {
    const std::vector<cc::test::Cage> cages = cc::test::ClosedCages();
    ServeCommands({
        {"placements",
         [](const Words&) { return Answer().Count("count", cc::test::AllPlacements().size()); }},
        {"count", [&](const Words& words) { return Count(cages, words); }},
    });
    return 0;
}
