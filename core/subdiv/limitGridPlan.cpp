#include "core/subdiv/limitGridPlan.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <numeric>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/subdiv/limitGrid.h"
#include "core/subdiv/limitHull.h"

namespace cc {
namespace {

/// Plans may take this much, or as much as this for every patch.
constexpr size_t kLeastPlanBytes = 1 << 20;
constexpr size_t kPlanBytesPerPatch = 48;

/// Vertices of higher valence are subdivided, however deep.
constexpr uint32_t kMaxPlannedValence = 16;

/// What decides a plan: topology and tags around a patch, and which of its control points are the
/// same.
using Signature = std::vector<uint32_t>;

uint32_t Bits(float value) {
    uint32_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    return bits;
}

/// Appends the shape of a ring, its tags counted as GatherControlPoints counts its points.
void AppendRing(const PatchTable& patches, const PatchRing& ring, uint32_t face,
                Signature* signature) {
    const uint32_t edgeCount = ring.faceCount + (ring.isClosed ? 0 : 1);
    const uint32_t first = ring.isClosed ? face : 0;
    const RingTags tags = patches.TagsOf(ring);
    signature->insert(
        signature->end(),
        {ring.faceCount, ring.isClosed, face - first, ring.outsideCount, ring.outsideNeighborCount,
         static_cast<uint32_t>(tags.decay), Bits(tags.vertexSharpness)});
    for (uint32_t edge = 0; edge < edgeCount; ++edge) {
        signature->push_back(Bits(tags.edgeSharpness[(first + edge) % edgeCount]));
    }
    if (tags.decay == SharpnessDecay::Chaikin) {
        signature->push_back(ring.seamCount);
        for (uint32_t edge = 0; edge < edgeCount; ++edge) {
            signature->push_back(Bits(tags.farSharpness[(first + edge) % edgeCount]));
        }
        for (const float sharpness : tags.seamSharpness) {
            signature->push_back(Bits(sharpness));
        }
    }
    for (const float sharpness : tags.outsideSharpness) {
        signature->push_back(Bits(sharpness));
    }
}

/// @param points  of GatherControlPoints
Signature MakeSignature(const PatchTable& patches, uint32_t patch, const ControlPoints& points) {
    Signature signature{static_cast<uint32_t>(patches.At(patch).kind)};
    if (patches.At(patch).kind == PatchKind::Irregular) {
        const uint32_t* corners = patches.Indices(patch);
        for (int corner = 0; corner < 4; ++corner) {
            AppendRing(patches, patches.Ring(corners[2 * corner]), corners[2 * corner + 1],
                       &signature);
        }
    }
    for (const uint32_t& point : points) {
        const auto* same = std::find(points.begin(), points.end(), point);
        signature.push_back(static_cast<uint32_t>(same - points.begin()));
    }
    return signature;
}

/// The places of control points that have not occurred before.
std::vector<uint16_t> MakePicks(const ControlPoints& points) {
    std::vector<uint16_t> picks;
    for (size_t i = 0; i < points.size(); ++i) {
        if (std::find(points.begin(), points.begin() + i, points[i]) == points.begin() + i) {
            picks.push_back(static_cast<uint16_t>(i));
        }
    }
    return picks;
}

/// The points of the finest limit grid, in rows along u.
struct LimitPoints {
    Vec3f at[kPlanSide + 1][kPlanSide + 1];

    template <class AnyPatch>
    void Evaluate(const AnyPatch& patch) {
        EvaluateLimitGrid(patch, {&at[0][0], kPlanSide + 1, kPlanSide});
    }
};

/// What a plan has weights for, of a patch with some control points.
struct PlannedPoints {
    LimitPoints grid;
    std::vector<Vec3f> hull;
};

template <class AnyPatch>
void Evaluate(const AnyPatch& patch, PlannedPoints* points) {
    points->grid.Evaluate(patch);
    points->hull.clear();
    AppendHull(patch, &points->hull);
}

/// Spreads one axis of the grid's points over a pick's weights.
void StoreWeights(const LimitPoints& points, int axis, float* weights) {
    for (int row = 0; row <= kPlanSide; ++row) {
        for (int column = 0; column < kPlanSide; ++column) {
            weights[kPlanSide * row + column] = points.at[row][column][axis];
        }
        weights[kPlanSide * (kPlanSide + 1) + row] = points.at[row][kPlanSide][axis];
    }
}

/// The weights of a hull's points, once each: neighbouring parts have some in common.
class HullWeights {
  public:
    explicit HullWeights(size_t pickCount) : _pickCount(pickCount) {}

    /// Takes the weights of one pick, for all points.
    void Set(size_t pick, const std::vector<Vec3f>& hull, int axis) {
        _rows.resize(hull.size(), std::vector<float>(_pickCount));
        for (size_t i = 0; i < hull.size(); ++i) {
            _rows[i][pick] = hull[i][axis];
        }
    }

    /// As LimitGridPlan has them.
    std::vector<float> Take() {
        std::sort(_rows.begin(), _rows.end());
        _rows.erase(std::unique(_rows.begin(), _rows.end()), _rows.end());
        while (_rows.size() % LimitGridPlan::kHullPadding != 0) {
            _rows.push_back(_rows.front());
        }
        std::vector<float> weights;
        for (size_t pick = 0; pick < _pickCount; ++pick) {
            for (const std::vector<float>& row : _rows) {
                weights.push_back(row[pick]);
            }
        }
        return weights;
    }

  private:
    size_t _pickCount;
    std::vector<std::vector<float>> _rows;
};

/// Evaluates a patch whose control points are 1 one after the other, three of them at a time.
/// @param values  one a patch point, all zero; zero again afterwards
LimitGridPlan MakePlan(const PatchTable& patches, uint32_t patch, std::vector<Vec3f>* zeroes) {
    std::vector<Vec3f>& values = *zeroes;
    ControlPoints points;
    GatherControlPoints(patches, patch, &points);
    std::vector<uint16_t> picks = MakePicks(points);
    std::vector<float> weights(picks.size() * LimitGridPlan::kWeightCount, 0.0f);
    HullWeights hull(picks.size());
    PlannedPoints planned;
    for (size_t first = 0; first < picks.size(); first += 3) {
        const size_t count = std::min<size_t>(3, picks.size() - first);
        for (size_t i = 0; i < count; ++i) {
            values[points[picks[first + i]]][static_cast<int>(i)] = 1;
        }
        if (patches.At(patch).kind == PatchKind::Irregular) {
            Evaluate(GatherIrregular(patches, patch, values.data()), &planned);
        } else {
            Evaluate(GatherExtraordinary(patches, patch, values.data()), &planned);
        }
        for (size_t i = 0; i < count; ++i) {
            values[points[picks[first + i]]] = {};
            StoreWeights(planned.grid, static_cast<int>(i),
                         &weights[(first + i) * LimitGridPlan::kWeightCount]);
            hull.Set(first + i, planned.hull, static_cast<int>(i));
        }
    }
    return LimitGridPlan(std::move(picks), std::move(weights), hull.Take());
}

/// The plan of an extraordinary patch whose points are all different.
LimitGridPlan MakePlanOfValence(int valence) {
    ExtraordinaryPatch::Points values;
    values.assign(2 * static_cast<size_t>(valence) + 8, Vec3f{});
    std::vector<uint16_t> picks(values.size());
    std::iota(picks.begin(), picks.end(), uint16_t(0));
    std::vector<float> weights(picks.size() * LimitGridPlan::kWeightCount, 0.0f);
    for (size_t i = 0; i < values.size(); ++i) {
        values[i].x = 1;
        LimitPoints grid;
        grid.Evaluate(ExtraordinaryPatch(values.data(), valence));
        values[i].x = 0;
        StoreWeights(grid, 0, &weights[i * LimitGridPlan::kWeightCount]);
    }
    return LimitGridPlan(std::move(picks), std::move(weights), {});
}

/// The plans of the process, by signature.
class PlanLibrary {
  public:
    static PlanLibrary& Get() {
        static PlanLibrary library;
        return library;
    }

    /// @param make  makes the plan if there is none
    template <class Make>
    std::shared_ptr<const LimitGridPlan> FindOrMake(const Signature& signature, const Make& make) {
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            if (auto plan = _plans[signature].lock()) {
                return plan;
            }
        }
        // Two threads may make the same plan: whoever is first keeps it.
        auto made = std::make_shared<const LimitGridPlan>(make());
        const std::lock_guard<std::mutex> lock(_mutex);
        auto& entry = _plans[signature];
        if (auto plan = entry.lock()) {
            return plan;
        }
        entry = made;
        return made;
    }

    size_t Bytes() {
        const std::lock_guard<std::mutex> lock(_mutex);
        size_t bytes = 0;
        for (const auto& [signature, entry] : _plans) {
            if (const auto plan = entry.lock()) {
                bytes += plan->Bytes();
            }
        }
        return bytes;
    }

  private:
    std::mutex _mutex;
    std::map<Signature, std::weak_ptr<const LimitGridPlan>> _plans;
};

/// The patches with one 1-ring.
struct Kin {
    std::vector<uint32_t> patches;
    size_t planBytes;
};

/// Groups all patches that can have plans by their 1-rings.
std::map<Signature, Kin> GroupPatches(const PatchTable& patches) {
    std::map<Signature, Kin> groups;
    ControlPoints points;
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        const PatchKind kind = patches.At(patch).kind;
        if (kind != PatchKind::Extraordinary && kind != PatchKind::Irregular) {
            continue;
        }
        GatherControlPoints(patches, patch, &points);
        const size_t bytes = points.size() * LimitGridPlan::kWeightCount * sizeof(float);
        if (bytes <= kLeastPlanBytes) {
            Kin& kin = groups[MakeSignature(patches, patch, points)];
            kin.patches.push_back(patch);
            kin.planBytes = bytes;
        }
    }
    return groups;
}

}  // namespace

void GatherControlPoints(const PatchTable& patches, uint32_t patch, ControlPoints* points) {
    const uint32_t* indices = patches.Indices(patch);
    points->resize(0);
    if (patches.At(patch).kind != PatchKind::Irregular) {
        points->assign(indices, indices + patches.IndexCount(patch));
        return;
    }
    for (int corner = 0; corner < 4; ++corner) {
        const PatchRing& ring = patches.Ring(indices[2 * corner]);
        const uint32_t* around = patches.RingIndices(ring);
        const uint32_t count = 2 * ring.faceCount + (ring.isClosed ? 0 : 1);
        const uint32_t first = ring.isClosed ? 2 * indices[2 * corner + 1] : 0;
        points->push_back(around[0]);
        for (uint32_t i = 0; i < count; ++i) {
            points->push_back(around[1 + (first + i < count ? first + i : first + i - count)]);
        }
        for (uint32_t i = 0; i < ring.outsideNeighborCount; ++i) {
            points->push_back(around[1 + count + i]);
        }
    }
}

LimitGridPlans::LimitGridPlans(const PatchTable& patches) {
    _AddValences(patches);
    const std::map<Signature, Kin> groups = GroupPatches(patches);
    std::vector<std::map<Signature, Kin>::const_iterator> order;
    for (auto group = groups.begin(); group != groups.end(); ++group) {
        order.push_back(group);
    }
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
        return a->second.patches.size() > b->second.patches.size();
    });
    size_t left = std::max(kLeastPlanBytes, kPlanBytesPerPatch * patches.Count());
    size_t planned = 0;
    for (; planned < std::min<size_t>(order.size(), UINT16_MAX - 1); ++planned) {
        if (order[planned]->second.planBytes > left) {
            break;
        }
        left -= order[planned]->second.planBytes;
    }
    if (planned == 0) {
        return;
    }
    _plans.resize(planned);
    _planOfPatch.assign(patches.Count(), 0);
    tbb::enumerable_thread_specific<std::vector<Vec3f>> zeroes(
        [&] { return std::vector<Vec3f>(patches.PointCount()); });
    tbb::parallel_for(size_t(0), planned, [&](size_t i) {
        const auto& [signature, kin] = *order[i];
        const uint32_t example = kin.patches.front();
        _plans[i] = PlanLibrary::Get().FindOrMake(
            signature, [&] { return MakePlan(patches, example, &zeroes.local()); });
        for (uint32_t patch : kin.patches) {
            _planOfPatch[patch] = static_cast<uint16_t>(i + 1);
        }
    });
}

void LimitGridPlans::_AddValences(const PatchTable& patches) {
    std::vector<bool> occurs(kMaxPlannedValence + 1, false);
    const auto note = [&](uint32_t valence) {
        if (valence <= kMaxPlannedValence) {
            occurs[valence] = true;
        }
    };
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        const uint32_t* corners = patches.Indices(patch);
        if (patches.At(patch).kind == PatchKind::Extraordinary) {
            note(patches.At(patch).valence);
        } else if (patches.At(patch).kind == PatchKind::Irregular) {
            for (int corner = 0; corner < 4; ++corner) {
                note(patches.Ring(corners[2 * corner]).faceCount);
            }
        }
    }
    occurs[0] = occurs[1] = occurs[2] = false;
    for (uint32_t valence = 3; valence <= kMaxPlannedValence; ++valence) {
        if (occurs[valence]) {
            _planOfValence.resize(valence + 1);
            _planOfValence[valence] = PlanLibrary::Get().FindOrMake(
                {valence}, [&] { return MakePlanOfValence(static_cast<int>(valence)); });
        }
    }
}

size_t LimitGridPlans::Bytes() const {
    return _planOfValence.capacity() * sizeof(_planOfValence[0]) +
           _plans.capacity() * sizeof(_plans[0]) + _planOfPatch.capacity() * sizeof(uint16_t);
}

size_t LimitGridPlans::SharedBytes() { return PlanLibrary::Get().Bytes(); }

}  // namespace cc
