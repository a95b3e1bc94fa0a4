#include "core/subdiv/loopBuilder.h"

#include <algorithm>
#include <array>
#include <map>

#include "core/subdiv/oneRing.h"
#include "core/subdiv/refinementLevel.h"
#include "core/subdiv/ringTable.h"

namespace cc {
namespace {

class LoopBuilder {
  public:
    LoopBuilder(RefinementLevel* level, PatchTable* table)
        : _level(level), _table(table), _rings(level, table) {}

    /// Adds the patch of a face. Returns false if a corner of it has no fan.
    bool AddFace(int face) {
        const auto vertices = _level->Topology().GetFaceVertices(face);
        bool isRegular = true;
        for (int corner = 0; corner < 3; ++corner) {
            if (!GatherCornerRing(*_level, vertices[corner], face, &_corners[corner])) {
                return false;
            }
            isRegular = isRegular && _corners[corner].tags.IsRegular(6);
        }
        if (isRegular) {
            _AddRegular(face);
        } else {
            _AddIrregular(face);
        }
        return true;
    }

  private:
    static Patch _MakePatch(const FaceOrigin& origin, PatchKind kind) {
        Patch patch{};
        patch.face = origin.face;
        patch.valence = 6;
        patch.kind = kind;
        return patch;
    }

    /// The patch point a + b - c, shared by all that ask for it.
    uint32_t _Extrapolate(uint32_t a, uint32_t b, uint32_t c) {
        const auto [entry, isNew] = _extrapolated.try_emplace({std::min(a, b), std::max(a, b), c});
        if (isNew) {
            entry->second = _table->AddPoint({{a, b, c}, {1, 1, -1}});
        }
        return entry->second;
    }

    /// The six neighbours of a regular vertex, as TriangleRing::RegularNeighbors has them.
    std::array<uint32_t, 6> _Neighbors(const CornerRing& ring, int face) {
        std::array<uint32_t, 6> all{};
        for (size_t i = 1; i < ring.vertices.size(); ++i) {
            all[i - 1] = _level->PatchPoint(ring.vertices[i], _table);
        }
        const uint32_t center = _level->PatchPoint(ring.vertices[0], _table);
        if (ring.vertices.size() == 5) {
            all[4] = _Extrapolate(center, all[3], all[2]);
            all[5] = _Extrapolate(center, all[0], all[1]);
        } else if (ring.vertices.size() == 3) {
            all[2] = _Extrapolate(center, all[1], all[0]);
            all[3] = _Extrapolate(center, center, all[0]);
            all[4] = _Extrapolate(center, center, all[1]);
            all[5] = _Extrapolate(center, all[0], all[1]);
        }
        const auto first = std::find(ring.faces.begin(), ring.faces.end(), face);
        std::rotate(all.begin(), all.begin() + (first - ring.faces.begin()), all.end());
        return all;
    }

    void _AddRegular(int face) {
        uint32_t points[12];
        for (int corner = 0; corner < 3; ++corner) {
            points[corner] = _level->PatchPoint(_corners[corner].vertices[0], _table);
            const std::array<uint32_t, 6> neighbors = _Neighbors(_corners[corner], face);
            std::copy(neighbors.begin() + 3, neighbors.end(), points + 3 + 3 * corner);
        }
        _table->AddPatch(_MakePatch(_level->Origin(face), PatchKind::RegularTriangle), points, 12);
    }

    void _AddIrregular(int face) {
        Patch patch = _MakePatch(_level->Origin(face), PatchKind::IrregularTriangle);
        uint32_t corners[6];
        for (int corner = 0; corner < 3; ++corner) {
            const RingPlace place = _rings.Add(_corners[corner], face);
            corners[2 * corner] = place.ring;
            corners[2 * corner + 1] = place.face;
            const size_t valence = _corners[corner].faces.size();
            patch.valence = static_cast<uint16_t>(std::max<size_t>(patch.valence, valence));
        }
        _table->AddPatch(patch, corners, 6);
    }

    RefinementLevel* const _level;
    PatchTable* const _table;
    RingTable _rings;
    CornerRing _corners[3];
    std::map<std::array<uint32_t, 3>, uint32_t> _extrapolated;
};

}  // namespace

void AddLoop(const ControlMesh& mesh, size_t pointCount, PatchTable* table, std::string* error) {
    RefinementLevel level(mesh, pointCount, error);
    if (!level.IsValid()) {
        if (error->empty()) {
            *error = "the topology cannot be used";
        }
        return;
    }
    LoopBuilder builder(&level, table);
    for (int face = 0; face < level.FaceCount(); ++face) {
        if (level.Origin(face).isVisible && !builder.AddFace(face)) {
            *error = "the triangles around a vertex of face " +
                     std::to_string(level.Origin(face).face) + " form no fan";
            return;
        }
    }
}

}  // namespace cc
