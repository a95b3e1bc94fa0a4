#pragma once

#include <string>

#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/trace/levelMetric.h"

/// A camera that looks straight down on all of a scene.
cc::Camera CameraFromAbove(const cc::Box3f& bounds);

/// Writes what a square picture shows of the levels that a metric chooses, for whatever camera that
/// is made: three floats a pixel, from the upper left: the level inside, or -1 where nothing is;
/// 1 in a fan, else 0; and how much the surface faces the ray. Throws std::runtime_error if the
/// file cannot be written.
void WriteLevelPicture(const cc::Scene& scene, const cc::LevelMetric& levels,
                       const cc::Camera& camera, int size, const std::string& path);
