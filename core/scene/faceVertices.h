#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace cc {

/// Which points the authored faces have: what is kept of a topology once its surface is built, for
/// primvars to be spread by. Face-vertices are numbered as in UsdGeomMesh faceVertexIndices.
class FaceVertices {
  public:
    FaceVertices() = default;

    /// Takes arrays that add up: the counts are those of the faces, and their sum is the number of
    /// indices.
    FaceVertices(const std::vector<int>& counts, std::vector<int> points)
        : _faceCount(counts.size()), _points(std::move(points)) {
        _points.shrink_to_fit();
        for (const int count : counts) {
            if (count != 4) {
                _ends.resize(counts.size());
                std::partial_sum(counts.begin(), counts.end(), _ends.begin());
                break;
            }
        }
    }

    size_t FaceCount() const { return _faceCount; }
    /// Number of face-vertices of all faces.
    size_t Count() const { return _points.size(); }
    size_t FirstOfFace(uint32_t face) const {
        return _ends.empty() ? size_t(4) * face : face == 0 ? 0 : _ends[face - 1];
    }
    int CountOfFace(uint32_t face) const {
        return _ends.empty() ? 4 : static_cast<int>(_ends[face] - FirstOfFace(face));
    }
    /// The point of a face-vertex.
    size_t Point(size_t faceVertex) const { return static_cast<size_t>(_points[faceVertex]); }

    /// Writes the arrays of UsdGeomMesh that this was made of.
    void CopyTo(std::vector<int>* counts, std::vector<int>* points) const {
        counts->clear();
        for (uint32_t face = 0; face < _faceCount; ++face) {
            counts->push_back(CountOfFace(face));
        }
        *points = _points;
    }

    size_t Bytes() const {
        return _points.capacity() * sizeof(int) + _ends.capacity() * sizeof(uint32_t);
    }

  private:
    size_t _faceCount = 0;
    std::vector<int> _points;
    /// The running sum of the counts; empty if all faces are quads.
    std::vector<uint32_t> _ends;
};

}  // namespace cc
