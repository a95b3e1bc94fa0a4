#include "core/subdiv/patchBuilder.h"

#include <algorithm>
#include <memory>
#include <unordered_map>

#include "core/subdiv/loopBuilder.h"
#include "core/subdiv/oneRing.h"
#include "core/subdiv/refinementLevel.h"
#include "core/subdiv/ringTable.h"

namespace cc {
namespace {

/// Refinement makes every face a quad in one step, and every fan one of quads in two. What then
/// still has no rings is no surface, and ends as bilinear quads.
constexpr int kMaxDepth = 2;

/// Emits the patches of one refinement level after the other.
class CatmullClarkBuilder {
  public:
    explicit CatmullClarkBuilder(PatchTable* table) : _table(table) {}

    /// Emits the patches of a level; returns the faces that need another step.
    std::vector<int> AddLevel(RefinementLevel* level) {
        std::vector<int> unfinished;
        RingTable rings(level, _table);
        const OneRings oneRings(level->Topology());
        for (int face = 0; face < level->FaceCount(); ++face) {
            if (!level->Origin(face).isVisible) {
                continue;
            }
            oneRings.Gather(face, &_ring);
            if (_ring.shape != FaceShape::Irregular) {
                _GatherGrid(level);
                if (_ring.shape == FaceShape::Regular) {
                    _AddRegular(level, face);
                } else {
                    _AddExtraordinary(level, face);
                }
            } else if (!_AddIrregular(level, face, &rings)) {
                if (level->Origin(face).depth < kMaxDepth) {
                    unfinished.push_back(face);
                } else {
                    _AddLimitQuad(level, face);
                }
            }
        }
        return unfinished;
    }

  private:
    static Patch _MakePatch(const FaceOrigin& origin, PatchKind kind) {
        Patch patch{};
        patch.face = origin.face;
        patch.corner = origin.corner;
        patch.cellU = origin.cellU;
        patch.cellV = origin.cellV;
        patch.valence = 4;
        patch.depth = origin.depth;
        patch.kind = kind;
        patch.isSubQuad = origin.isSubQuad;
        return patch;
    }

    uint32_t& _At(GridPosition p) { return _grid[p.row][p.column]; }

    /// The patch point 2a - b, shared by all that ask for it (paper, Figure 2d).
    uint32_t _Extrapolate(uint32_t a, uint32_t b) {
        const auto [entry, isNew] = _extrapolated.try_emplace(uint64_t(a) << 32 | b, 0);
        if (isNew) {
            entry->second = _table->AddExtrapolatedPoint(a, b);
        }
        return entry->second;
    }

    /// Turns the ring's vertices into patch points and fills what lies beyond open edges.
    void _GatherGrid(RefinementLevel* level) {
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 4; ++column) {
                const int vertex = _ring.grid[row][column];
                if (vertex != OneRing::kExtrapolated) {
                    _grid[row][column] = level->PatchPoint(vertex, _table);
                }
            }
        }
        for (int edge = 0; edge < 4; ++edge) {
            if (_ring.isOpen[edge]) {
                const int a = edge, b = edge + 1;
                _At(GridAcross(a, edge)) =
                    _Extrapolate(_At(GridCorner(a)), _At(GridCorner(edge + 3)));
                _At(GridAcross(b, edge)) =
                    _Extrapolate(_At(GridCorner(b)), _At(GridCorner(edge + 2)));
            }
        }
        for (int corner = 0; corner < 4; ++corner) {
            const int next = corner, previous = (corner + 3) & 3;
            if (_ring.isOpen[next]) {
                _At(GridDiagonal(corner)) = _Extrapolate(_At(GridAcross(corner, previous)),
                                                         _At(GridAcross(previous, previous)));
            } else if (_ring.isOpen[previous]) {
                _At(GridDiagonal(corner)) =
                    _Extrapolate(_At(GridAcross(corner, next)), _At(GridAcross(corner + 1, next)));
            }
        }
    }

    /// Adds a patch of a face.
    /// @param patch  whose rotation is set
    void _Add(RefinementLevel* level, int face, Patch patch, const uint32_t* indices, int count) {
        const int corner = level->OuterCorner(face);
        patch.outerCorner = (corner - patch.rotation) & 3;
        _table->AddPatch(patch, indices, count);
        if (patch.depth > 0) {
            _table->AddOuterEdges(level->EdgeEnds(face, corner, _table),
                                  level->EdgeEnds(face, (corner + 3) & 3, _table));
        }
    }

    void _AddRegular(RefinementLevel* level, int face) {
        _Add(level, face, _MakePatch(level->Origin(face), PatchKind::Regular), &_grid[0][0], 16);
    }

    void _AddExtraordinary(RefinementLevel* level, int face) {
        const int corner = _ring.extraordinaryCorner;
        std::vector<uint32_t>& points = _points;
        points.assign(1, _At(GridCorner(corner)));
        for (int vertex : _ring.extraordinaryRing) {
            points.push_back(level->PatchPoint(vertex, _table));
        }
        const int c1 = corner + 1, c2 = corner + 2, c3 = corner + 3;
        points.insert(points.end(),
                      {_At(GridDiagonal(c1)), _At(GridAcross(c1, c1)), _At(GridAcross(c2, c1)),
                       _At(GridDiagonal(c2)), _At(GridAcross(c2, c2)), _At(GridAcross(c3, c2)),
                       _At(GridDiagonal(c3))});
        Patch patch = _MakePatch(level->Origin(face), PatchKind::Extraordinary);
        patch.valence = static_cast<uint16_t>(_ring.extraordinaryRing.size() / 2);
        patch.rotation = corner & 3;
        _Add(level, face, patch, points.data(), static_cast<int>(points.size()));
    }

    /// Adds a quad with the rings of its corners. Returns false if it has none.
    bool _AddIrregular(RefinementLevel* level, int face, RingTable* rings) {
        const auto vertices = level->Topology().GetFaceVertices(face);
        if (vertices.size() != 4) {
            return false;
        }
        uint32_t corners[8];
        Patch patch = _MakePatch(level->Origin(face), PatchKind::Irregular);
        for (int corner = 0; corner < 4; ++corner) {
            RingPlace place;
            if (!rings->Find(vertices[corner], face, &place)) {
                return false;
            }
            corners[2 * corner] = place.ring;
            corners[2 * corner + 1] = place.face;
            const uint32_t valence = _table->Ring(place.ring).faceCount;
            patch.valence = static_cast<uint16_t>(std::max<uint32_t>(patch.valence, valence));
        }
        _Add(level, face, patch, corners, 8);
        return true;
    }

    void _AddLimitQuad(RefinementLevel* level, int face) {
        uint32_t points[4];
        const auto vertices = level->Topology().GetFaceVertices(face);
        for (int i = 0; i < 4; ++i) {
            points[i] = level->LimitPoint(vertices[i], _table);
        }
        _table->NoteLimitQuads();
        _Add(level, face, _MakePatch(level->Origin(face), PatchKind::Bilinear), points, 4);
    }

    PatchTable* const _table;
    OneRing _ring;
    std::vector<uint32_t> _points;
    uint32_t _grid[4][4];
    /// By the two points.
    std::unordered_map<uint64_t, uint32_t> _extrapolated;
};

void AddCatmullClark(const ControlMesh& mesh, size_t pointCount, PatchTable* table,
                     std::string* error) {
    std::vector<std::unique_ptr<RefinementLevel>> levels;
    levels.push_back(std::make_unique<RefinementLevel>(mesh, pointCount, error));
    CatmullClarkBuilder builder(table);
    while (levels.back()->IsValid()) {
        const std::vector<int> unfinished = builder.AddLevel(levels.back().get());
        if (unfinished.empty()) {
            return;
        }
        levels.push_back(std::make_unique<RefinementLevel>(levels.back().get(), unfinished));
    }
    if (error->empty()) {
        *error = "the topology cannot be refined";
    }
}

/// Bilinear faces: a quad is its own patch, an n-gon becomes n of them.
void AddBilinear(const ControlMesh& mesh, PatchTable* table) {
    std::vector<char> isHole(mesh.faceVertexCounts.size(), 0);
    for (int hole : mesh.holeIndices) {
        isHole[hole] = 1;
    }
    const int* vertices = mesh.faceVertexIndices.data();
    for (uint32_t face = 0; face < mesh.faceVertexCounts.size(); ++face) {
        const std::vector<int> kept = KeptCorners(vertices, mesh.faceVertexCounts[face]);
        std::vector<uint32_t> points;
        for (int corner : kept) {
            points.push_back(static_cast<uint32_t>(vertices[corner]));
        }
        vertices += mesh.faceVertexCounts[face];
        if (isHole[face] || kept.empty()) {
            continue;
        }
        const auto count = static_cast<int>(kept.size());
        Patch patch{};
        patch.face = face;
        patch.valence = 4;
        patch.kind = PatchKind::Bilinear;
        if (count == 4) {
            table->AddPatch(patch, points.data(), 4);
            continue;
        }
        patch.depth = 1;
        patch.isSubQuad = 1;
        const uint32_t center =
            table->AddPoint({points, std::vector<float>(count, 1.0f / static_cast<float>(count))});
        std::vector<uint32_t> middles;
        for (int i = 0; i < count; ++i) {
            middles.push_back(
                table->AddPoint({{points[i], points[(i + 1) % count]}, {0.5f, 0.5f}}));
        }
        for (int i = 0; i < count; ++i) {
            patch.corner = static_cast<uint32_t>(kept[i]);
            const uint32_t quad[4] = {points[i], middles[i], center,
                                      middles[(i + count - 1) % count]};
            table->AddPatch(patch, quad, 4);
            table->AddOuterEdges({points[i], points[(i + 1) % count]},
                                 {points[(i + count - 1) % count], points[i]});
        }
    }
}

/// Polygons, as fans of triangles. They may meet a vertex twice: a bridge to a hole does.
void AddPolygons(const ControlMesh& mesh, PatchTable* table) {
    std::vector<char> isHole(mesh.faceVertexCounts.size(), 0);
    for (int hole : mesh.holeIndices) {
        isHole[hole] = 1;
    }
    const int* vertices = mesh.faceVertexIndices.data();
    for (uint32_t face = 0; face < mesh.faceVertexCounts.size(); ++face) {
        const int count = mesh.faceVertexCounts[face];
        const std::vector<uint32_t> points(vertices, vertices + count);
        vertices += count;
        std::vector<PolygonTriangle> fan;
        for (uint32_t i = 2; i < points.size() && !isHole[face]; ++i) {
            fan.push_back({0, i - 1, i});
        }
        table->AddPolygon(face, points, fan);
    }
}

}  // namespace

void CutPolygons(const std::vector<Vec3f>& points, PatchTable* table) {
    if (table->Count() == 0 || table->At(0).kind != PatchKind::FlatTriangle) {
        return;
    }
    uint32_t end = 0;
    for (uint32_t first = 0; first < table->Count(); first = end) {
        const uint32_t face = table->AuthoredFace(first);
        end = first;
        while (end < table->Count() && table->AuthoredFace(end) == face) {
            ++end;
        }
        if (end - first < 2) {
            continue;
        }
        std::vector<uint32_t> corners(end - first + 2);
        for (uint32_t patch = first; patch < end; ++patch) {
            const PolygonTriangle triangle = table->TriangleCorners(patch);
            for (int i = 0; i < 3; ++i) {
                corners[triangle[i]] = table->Indices(patch)[i];
            }
        }
        std::vector<Vec3f> positions;
        for (uint32_t point : corners) {
            positions.push_back(points[point]);
        }
        table->RecutPolygon(first, corners, TriangulatePolygon(positions));
    }
}

PatchTable BuildPatchTable(const ControlMesh& mesh, size_t pointCount, std::string* error) {
    error->clear();
    const SharpnessDecay decay =
        mesh.creaseRule == CreaseRule::Chaikin ? SharpnessDecay::Chaikin : SharpnessDecay::Uniform;
    PatchTable table(pointCount, mesh.leftHanded, decay);
    if (mesh.scheme == Scheme::CatmullClark) {
        AddCatmullClark(mesh, pointCount, &table, error);
    } else if (mesh.scheme == Scheme::Loop) {
        AddLoop(mesh, pointCount, &table, error);
    } else if (mesh.scheme == Scheme::Bilinear) {
        AddBilinear(mesh, &table);
    } else {
        AddPolygons(mesh, &table);
    }
    if (!error->empty()) {
        return PatchTable(pointCount, mesh.leftHanded, decay);
    }
    table.Finish();
    return table;
}

}  // namespace cc
