#include "hdCC/renderStats.h"

#include <sys/resource.h>

#include <algorithm>
#include <string>

#include "pxr/base/vt/array.h"
#include "pxr/base/vt/types.h"
#include "pxr/base/vt/value.h"

#include "hdCC/renderParam.h"

PXR_NAMESPACE_OPEN_SCOPE

static double _Ratio(double a, double b) { return b > 0 ? a / b : 0.0; }

static VtDictionary _RayRates(cc::RenderStatistics const &statistics) {
    // Seconds are added up over threads; a rate is what all of them do together.
    const double scale = 1e-6 * statistics.threads;
    VtDictionary rates;
    rates["primary"] =
        VtValue(scale * _Ratio(double(statistics.primaryRays), statistics.primarySeconds));
    rates["shadow"] =
        VtValue(scale * _Ratio(double(statistics.shadowRays), statistics.shadowSeconds));
    rates["reflection"] = VtValue(0.0);
    return rates;
}

static VtDictionary _PerPacket(cc::TraceStatistics const &trace) {
    VtDictionary averages;
    const auto add = [&](char const *name, uint64_t count) {
        averages[name] = VtValue(_Ratio(double(count), double(trace.packets)));
    };
    add("traversals", trace.traversals);
    add("leaf_intersections", trace.leafIntersections);
    add("subdivisions_regular", trace.subdivisionsRegular);
    add("subdivisions_irregular", trace.subdivisionsIrregular);
    add("early_hit", trace.earlyHits);
    add("interval_culls", trace.intervalCulls);
    add("final_intersections", trace.finalIntersections);
    add("active_lanes", trace.activeLanes);
    return averages;
}

static VtDictionary _Levels(HdCCFrame const &frame) {
    auto const &counts = frame.statistics.patchesByLevel;
    int least = 0, most = 0;
    for (int level = int(counts.size()) - 1; level >= 0; --level) {
        least = counts[level] > 0 ? level : least;
        most = std::max(most, counts[level] > 0 ? level : 0);
    }
    VtDictionary levels;
    levels["min"] = VtValue(least);
    levels["max"] = VtValue(most);
    levels["histogram"] = VtValue(VtInt64Array(counts.begin(), counts.begin() + most + 1));
    return levels;
}

static int64_t _PeakResidentBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return int64_t(usage.ru_maxrss) * 1024;
}

/// What other renderers tell under the same names, for applications that show it.
static void _AddCommonNames(HdCCFrame const &frame, VtDictionary *stats) {
    const double loading = frame.syncSeconds + frame.scene.buildSeconds;
    VtDictionary &common = *stats;
    common["rendererName"] = VtValue(std::string("hdCC"));
    common["numCompletedSamples"] = VtValue(frame.samples);
    common["loadClockTime"] = VtValue(loading);
    common["totalClockTime"] = VtValue(loading + frame.statistics.seconds);
    common["totalMemory"] = VtValue(int64_t(frame.scene.bytes));
    common["peakMemory"] = VtValue(_PeakResidentBytes());
    common["polyCounts"] = VtValue(int64_t(frame.scene.faces));
    common["cameraRays"] = VtValue(int64_t(frame.statistics.primaryRays));
    common["occlusionRays"] = VtValue(int64_t(frame.statistics.shadowRays));
}

VtDictionary HdCCRenderStats(HdCCFrame const &frame) {
    VtDictionary seconds, rays, bytes;
    seconds["sync"] = VtValue(frame.syncSeconds);
    seconds["build"] = VtValue(frame.scene.buildSeconds);
    seconds["trace"] = VtValue(frame.statistics.seconds);
    rays["primary"] = VtValue(int64_t(frame.statistics.primaryRays));
    rays["shadow"] = VtValue(int64_t(frame.statistics.shadowRays));
    rays["reflection"] = VtValue(int64_t(0));
    bytes["structures"] = VtValue(int64_t(frame.scene.bytes));
    bytes["per_face"] = VtValue(_Ratio(double(frame.scene.bytes), double(frame.scene.faces)));
    bytes["peak_rss"] = VtValue(_PeakResidentBytes());

    VtDictionary stats;
    stats["faces"] = VtValue(int64_t(frame.scene.faces));
    stats["patches"] = VtValue(int64_t(frame.scene.patches));
    stats["materials"] =
        VtValue(VtStringArray(frame.scene.materials.begin(), frame.scene.materials.end()));
    stats["instances"] = VtValue(int64_t(frame.scene.instances));
    stats["seconds"] = VtValue(seconds);
    stats["rays"] = VtValue(rays);
    stats["mrays_per_second"] = VtValue(_RayRates(frame.statistics));
    stats["bytes"] = VtValue(bytes);
    stats["levels"] = VtValue(_Levels(frame));
    stats["packet"] = VtValue(_PerPacket(frame.statistics.trace));
    _AddCommonNames(frame, &stats);
    return stats;
}

PXR_NAMESPACE_CLOSE_SCOPE
