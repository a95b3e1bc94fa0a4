#include "core/subdiv/ringTags.h"

#include <algorithm>

namespace cc {
namespace {

bool IsInfinite(float sharpness) { return sharpness >= kInfiniteSharpness; }
bool IsSemiSharp(float sharpness) { return sharpness > 0 && !IsInfinite(sharpness); }
bool IsSharp(float sharpness) { return sharpness > 0; }

float DecayUniformly(float sharpness) {
    return IsInfinite(sharpness) ? kInfiniteSharpness : std::max(sharpness - 1, 0.0f);
}

/// Chaikin's rule: neighbouring semi-sharp edges pull on each other before sharpness decays.
/// @param others  their mean sharpness
float DecayByNeighbors(float sharpness, float others) {
    return IsSemiSharp(sharpness) ? std::max(0.75f * sharpness + 0.25f * others - 1, 0.0f)
                                  : DecayUniformly(sharpness);
}

/// The sharpnesses that pull on each other.
struct SemiSharpSum {
    float sum = 0;
    int count = 0;

    explicit SemiSharpSum(const RingTags& tags) {
        _Add(tags.edgeSharpness);
        _Add(tags.outsideSharpness);
        _Add(tags.seamSharpness);
    }
    float MeanWithout(float sharpness) const {
        return IsSemiSharp(sharpness) && count > 1
                   ? (sum - sharpness) / static_cast<float>(count - 1)
                   : sharpness;
    }

  private:
    template <typename Sharpnesses>
    void _Add(const Sharpnesses& sharpnesses) {
        for (float s : sharpnesses) {
            sum += IsSemiSharp(s) ? s : 0;
            count += IsSemiSharp(s);
        }
    }
};

}  // namespace

RingTags::Rule RingTags::VertexRule() const {
    if (vertexSharpness > 0) {
        return Rule::Corner;
    }
    // With one neighbour outside, the ring's first edge is its last.
    const auto sharp = std::count_if(edgeSharpness.begin(), edgeSharpness.end(), IsSharp) +
                       std::count_if(outsideSharpness.begin(), outsideSharpness.end(), IsSharp) -
                       (outsideNeighborCount == 1 ? 1 : 0);
    return sharp > 2 ? Rule::Corner : sharp == 2 ? Rule::Crease : Rule::Smooth;
}

bool RingTags::IsSettled() const {
    return !IsSemiSharp(vertexSharpness) &&
           std::none_of(edgeSharpness.begin(), edgeSharpness.end(), IsSemiSharp) &&
           std::none_of(outsideSharpness.begin(), outsideSharpness.end(), IsSemiSharp);
}

bool RingTags::IsSmooth() const {
    return isClosed && VertexRule() == Rule::Smooth &&
           std::none_of(edgeSharpness.begin(), edgeSharpness.end(), IsSharp);
}

bool RingTags::IsDart() const {
    return isClosed && std::any_of(edgeSharpness.begin(), edgeSharpness.end(), IsSharp) &&
           VertexRule() == Rule::Smooth;
}

bool RingTags::IsRegular(int smoothFaceCount) const {
    if (IsSmooth()) {
        return FaceCount() == smoothFaceCount;
    }
    if (!IsSettled() || IsDart()) {
        return false;
    }
    switch (VertexRule()) {
        case Rule::Smooth: return FaceCount() == smoothFaceCount;
        case Rule::Crease: return FaceCount() == smoothFaceCount / 2 && outsideNeighborCount == 0;
        case Rule::Corner: return FaceCount() == 1;
    }
    return false;
}

RingTags RingTags::Decayed() const {
    const bool isChaikin = decay == SharpnessDecay::Chaikin;
    const SemiSharpSum sum(*this);
    const auto decayedOf = [&](float s) {
        return isChaikin ? DecayByNeighbors(s, sum.MeanWithout(s)) : DecayUniformly(s);
    };
    RingTags decayed;
    decayed.isClosed = isClosed;
    decayed.outsideNeighborCount = outsideNeighborCount;
    decayed.decay = decay;
    for (int j = 0; j < static_cast<int>(edgeSharpness.size()); ++j) {
        const float near = decayedOf(edgeSharpness[j]);
        decayed.edgeSharpness.push_back(near);
        if (isChaikin) {
            // Beyond the edge's middle there is only its other half.
            const float far = FarDecayed(j);
            decayed.farSharpness.push_back(IsSemiSharp(far) ? far : near);
        }
    }
    for (float s : outsideSharpness) {
        decayed.outsideSharpness.push_back(decayedOf(s));
    }
    for (float s : seamSharpness) {
        decayed.seamSharpness.push_back(decayedOf(s));
    }
    decayed.vertexSharpness = DecayUniformly(vertexSharpness);
    return decayed;
}

float RingTags::FarDecayed(int edge) const {
    return decay == SharpnessDecay::Chaikin
               ? DecayByNeighbors(edgeSharpness[edge], farSharpness[edge])
               : DecayUniformly(edgeSharpness[edge]);
}

float RingTags::OtherSharpness(int edge) const {
    return SemiSharpSum(*this).MeanWithout(edgeSharpness[edge]);
}

float RingTags::EdgeWeight(int edge, const RingTags& decayed) const {
    const bool isOutside = edge >= static_cast<int>(edgeSharpness.size());
    const bool staysSharp = isOutside || (decayed.edgeSharpness[edge] > 0 && FarDecayed(edge) > 0);
    return staysSharp ? 1 : edgeSharpness[edge];
}

float RingTags::FractionalWeight(const RingTags& decayed) const {
    float sum = 0;
    int count = 0;
    const auto add = [&](float before, float after) {
        if (IsSemiSharp(before) && after <= 0) {
            sum += before;
            ++count;
        }
    };
    for (size_t j = 0; j < edgeSharpness.size(); ++j) {
        add(edgeSharpness[j], decayed.edgeSharpness[j]);
    }
    for (size_t j = 0; j < outsideSharpness.size(); ++j) {
        add(outsideSharpness[j], decayed.outsideSharpness[j]);
    }
    add(vertexSharpness, decayed.vertexSharpness);
    return count > 0 ? std::min(sum / static_cast<float>(count), 1.0f) : 0;
}

void RingTags::CreaseEdges(int edges[2]) const {
    // What is outside comes last.
    const int last = NeighborCount() - 1;
    edges[0] = isClosed ? last - 1 : 0;
    edges[1] = last;
    if (!isClosed || outsideNeighborCount == 2) {
        return;
    }
    int found = 0;
    for (int j = 0; j < static_cast<int>(edgeSharpness.size()) && found < 2; ++j) {
        if (IsSharp(edgeSharpness[j])) {
            edges[found++] = j;
        }
    }
}

}  // namespace cc
