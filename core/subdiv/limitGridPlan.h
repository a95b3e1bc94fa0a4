#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/math/inlineVector.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// The finest grid that is made into a plan: 2^4 x 2^4 quads.
constexpr int kPlanSplits = 4;
constexpr int kPlanSide = 1 << kPlanSplits;

/// How the finest limit grid of a patch, and a hull around it, follow from its control points:
/// every point is a weighted sum of them. The weights depend on topology and tags alone, so that
/// all patches with the same 1-ring share a plan; with one, an extraordinary or creased patch is
/// evaluated and bounded without any subdivision.
class LimitGridPlan {
  public:
    /// Weights are in the order of a limit grid: rows 0..16 of columns 0..15, then column 16 of all
    /// rows; padded to a multiple of 64.
    static constexpr int kWeightCount = (kPlanSide + 4) * kPlanSide;
    /// The points of a hull are padded to a multiple of this.
    static constexpr int kHullPadding = 32;

    /// @param picks    the control points that count, by their places in ControlPoints
    /// @param weights  kWeightCount for each pick
    /// @param hull     as many for each pick as the hull has points (AppendHull)
    LimitGridPlan(std::vector<uint16_t> picks, std::vector<float> weights, std::vector<float> hull)
        : _picks(std::move(picks)), _weights(std::move(weights)), _hull(std::move(hull)) {}

    const std::vector<uint16_t>& Picks() const { return _picks; }
    const float* Weights(size_t pick) const { return &_weights[pick * kWeightCount]; }
    /// Points whose convex hull holds the surface; 0 if the plan has no hull.
    size_t HullCount() const { return _hull.size() / _picks.size(); }
    const float* HullWeights(size_t pick) const { return _hull.data() + pick * HullCount(); }
    size_t Bytes() const {
        return _picks.capacity() * sizeof(uint16_t) +
               (_weights.capacity() + _hull.capacity()) * sizeof(float);
    }

  private:
    std::vector<uint16_t> _picks;
    std::vector<float> _weights, _hull;
};

/// Patch points by their index; those of common patches need no allocation.
using ControlPoints = InlineVector<uint32_t, 64>;

/// All points that shape an extraordinary or irregular patch, some of them more than once: for an
/// irregular patch the rings of its corners, closed ones from the patch's own face on, so that the
/// order is the same wherever the same 1-ring occurs.
void GatherControlPoints(const PatchTable& patches, uint32_t patch, ControlPoints* points);

/// The plans of a patch table. Equal plans are made once in the process and live as long as any
/// table that uses them.
class LimitGridPlans {
  public:
    LimitGridPlans() = default;
    /// Plans for the commonest 1-rings first, as long as they stay small beside the table. Patches
    /// with other 1-rings have no plan and are subdivided where rays meet them.
    explicit LimitGridPlans(const PatchTable& patches);

    /// Null for regular and bilinear patches, and for those without a plan.
    const LimitGridPlan* Of(uint32_t patch) const {
        const uint32_t plan = _planOfPatch.empty() ? 0 : _planOfPatch[patch];
        return plan == 0 ? nullptr : _plans[plan - 1].get();
    }
    /// The plan of an ExtraordinaryPatch, its points in their own order: for what is left of a
    /// patch that has been subdivided. Null if no patch of the table has a vertex of that valence.
    const LimitGridPlan* OfValence(int valence) const {
        const auto index = static_cast<size_t>(valence);
        return index < _planOfValence.size() ? _planOfValence[index].get() : nullptr;
    }
    /// Memory held, in bytes, without the plans themselves.
    size_t Bytes() const;
    /// Memory of all plans in the process, in bytes.
    static size_t SharedBytes();

  private:
    void _AddValences(const PatchTable& patches);

    std::vector<std::shared_ptr<const LimitGridPlan>> _plans;
    std::vector<std::shared_ptr<const LimitGridPlan>> _planOfValence;
    /// Number of the plan plus one, or 0. Empty if no patch has one.
    std::vector<uint16_t> _planOfPatch;
};

}  // namespace cc
