#pragma once

#include <embree3/rtcore.h>

#include <string>

#include "rays.h"

/// Traces a set with one of Embree's interfaces:
///
///     1                  rtcIntersect1, rtcOccluded1
///     16  16-coherent    rtcIntersect16, rtcOccluded16, without and with the coherent flag
///     1M  1M-coherent    streams of rays, one structure a ray
///     Np  Np-coherent    streams of rays, one array a component
///
/// Throws std::runtime_error for another name.
TraceRun TraceWithEmbree(RTCScene scene, const std::string& interface, const RaySet& set,
                         int threads);
