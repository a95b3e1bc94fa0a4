#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <variant>

#include "core/math/vec.h"

namespace cc {

/// The finest level that there is.
constexpr int kFinestLevel = 8;

/// Into how many quads a patch is cut: 2^level along a base edge, inside and at each of its edges.
struct PatchLevels {
    uint8_t interior = 0;
    uint8_t edges[4] = {0, 0, 0, 0};  ///< edge 0 is v = 0, 1 is u = 1, 2 is v = 1, 3 is u = 0

    int Finest() const { return std::max({interior, edges[0], edges[1], edges[2], edges[3]}); }
    int Coarsest() const { return std::min({interior, edges[0], edges[1], edges[2], edges[3]}); }
    bool AreEqual() const { return Finest() == Coarsest(); }
    bool operator==(const PatchLevels& b) const {
        return interior == b.interior && edges[0] == b.edges[0] && edges[1] == b.edges[1] &&
               edges[2] == b.edges[2] && edges[3] == b.edges[3];
    }
};

/// What levels need to know of a camera.
struct LevelView {
    std::array<double, 3> eye;
    Vec3f forward;  ///< unit, into the picture
    float pixels;   ///< that a unit covers at most: at distance 1 if it is not orthographic
    bool isOrthographic;
    /// The least depth of what is seen, by its distance from the eye. What is nearer to the plane
    /// of the eye than half of that is out of sight.
    float leastCosine;
};

/// Every patch alike.
struct UniformMetric {
    int finest;  ///< 0..8
};

/// Patches as finely as a camera needs them (PixelErrorLevels).
struct PixelErrorMetric {
    LevelView view;
    float pixelError;  ///< how far quads may be from the surface in the picture, in pixels; above 0
    int finest;        ///< 0..8, the finest level, however large an error that leaves
    /// The same for instances in whose bounds no ray of a packet starts, if that is more
    /// (IsRemote).
    float remoteError = 0;

    /// What such instances are cut by.
    PixelErrorMetric Remote() const {
        return {view, std::max(pixelError, remoteError), finest, remoteError};
    }
};

/// Patches at three levels, by their distance (DistanceLevels).
struct DistanceMetric {
    std::array<double, 3> eye;
    /// Where level 0 ends: the paper's alpha times the diameter of the scene; above 0.
    float reach;
    int finest;  ///< 0..8; the others are the two below it
};

/// How finely surfaces are cut.
class LevelMetric {
  public:
    using Rule = std::variant<UniformMetric, PixelErrorMetric, DistanceMetric>;

    LevelMetric(int level) : _rule(UniformMetric{level}) {}  // NOLINT(google-explicit-constructor)
    LevelMetric(const PixelErrorMetric& rule)
        : _rule(rule) {}                                      // NOLINT(google-explicit-constructor)
    LevelMetric(const DistanceMetric& rule) : _rule(rule) {}  // NOLINT(google-explicit-constructor)

    const Rule& GetRule() const { return _rule; }
    /// True if instances that rays start in may be finer than others.
    bool HasRemote() const {
        const auto* rule = std::get_if<PixelErrorMetric>(&_rule);
        return rule && rule->remoteError > rule->pixelError;
    }
    /// Of tracers that cut all patches alike.
    int Finest() const {
        return std::visit([](const auto& rule) { return rule.finest; }, _rule);
    }

  private:
    Rule _rule;
};

}  // namespace cc
