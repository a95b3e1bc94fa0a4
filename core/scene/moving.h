#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace cc {

/// Something that is known at a few times and changes steadily in between. Before the first time
/// and after the last it rests. Times count frames from the one that is rendered.
template <class T>
class Moving {
  public:
    /// Rests, as T() is.
    Moving() : _times{0}, _poses(1) {}
    /// Rests.
    explicit Moving(T pose) : _times{0} { _poses.push_back(std::move(pose)); }
    /// @param times  rising
    /// @param poses  one a time; at least one
    Moving(std::vector<float> times, std::vector<T> poses)
        : _times(std::move(times)), _poses(std::move(poses)) {}

    bool IsMoving() const { return _poses.size() > 1; }
    const std::vector<float>& Times() const { return _times; }
    const std::vector<T>& Poses() const { return _poses; }
    std::vector<T>& Poses() { return _poses; }

    /// The poses about a time, and how far it is from the first to the second, 0..1.
    struct Between {
        const T& first;
        const T& second;
        float weight;
    };
    Between At(float time) const {
        const size_t next = std::upper_bound(_times.begin(), _times.end(), time) - _times.begin();
        if (next == 0 || next == _times.size()) {
            const T& end = next == 0 ? _poses.front() : _poses.back();
            return {end, end, 0};
        }
        const float before = _times[next - 1], after = _times[next];
        return {_poses[next - 1], _poses[next], (time - before) / (after - before)};
    }

    bool operator==(const Moving& b) const { return _times == b._times && _poses == b._poses; }
    bool operator!=(const Moving& b) const { return !(*this == b); }

  private:
    std::vector<float> _times;
    std::vector<T> _poses;
};

}  // namespace cc
