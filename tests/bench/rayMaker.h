#pragma once

#include <vector>

#include "benchScene.h"
#include "core/scene/scene.h"
#include "core/trace/tracer.h"
#include "rays.h"

/// Crops the longer sides of a camera's window.
void MakeSquare(cc::Camera* camera);

/// A ray through the centre of each pixel of a square picture, in tiles of 8x8 pixels: "primary".
/// Where the camera's window is not square, its longer sides are cropped.
RaySet MakePrimaryRays(const cc::Camera& camera, int size);

/// What follows from the nearest hits of primary rays, in packets that stay together: "shadow",
/// rays to two point lights, one packet a light, without those to a light behind the surface;
/// "reflection", mirrored rays; and "reflection-shadow", shadow rays from what those hit.
std::vector<RaySet> MakeSecondaryRays(const cc::Scene& scene,
                                      const std::array<cc::Vec3f, 2>& lights, const RaySet& primary,
                                      const cc::Tracer& tracer);
