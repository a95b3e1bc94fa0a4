#include "core/subdiv/refinementLevel.h"

#include <algorithm>
#include <mutex>
#include <numeric>

#include <opensubdiv/far/error.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/sdc/crease.h>

namespace cc {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

constexpr uint32_t kNoPoint = 0xffffffffu;

thread_local std::string* currentError = nullptr;

/// Keeps OpenSubdiv's messages off stderr: the last one becomes the reason of a failure.
void CatchMessages() {
    static std::once_flag once;
    std::call_once(once, [] {
        Far::SetErrorCallback([](Far::ErrorType, const char* message) {
            if (currentError != nullptr) {
                *currentError = message;
            }
        });
        Far::SetWarningCallback([](const char*) {});
    });
}

/// A mesh as OpenSubdiv's factory takes it, with its arrays.
struct Description {
    std::vector<int> counts, indices;
    std::vector<int> creaseVertices;
    std::vector<float> creaseSharpness;
    std::vector<int> cornerVertices;
    std::vector<float> cornerSharpness;
    int vertexCount = 0;

    void AddCrease(int a, int b, float sharpness) {
        creaseVertices.push_back(a);
        creaseVertices.push_back(b);
        creaseSharpness.push_back(sharpness);
    }
    void AddCorner(int vertex, float sharpness) {
        cornerVertices.push_back(vertex);
        cornerSharpness.push_back(sharpness);
    }

    std::unique_ptr<Far::TopologyRefiner> CreateRefiner(Sdc::SchemeType scheme,
                                                        const Sdc::Options& options) const {
        Far::TopologyDescriptor d;
        d.numVertices = vertexCount;
        d.numFaces = static_cast<int>(counts.size());
        d.numVertsPerFace = counts.data();
        d.vertIndicesPerFace = indices.data();
        d.numCreases = static_cast<int>(creaseSharpness.size());
        d.creaseVertexIndexPairs = creaseVertices.data();
        d.creaseWeights = creaseSharpness.data();
        d.numCorners = static_cast<int>(cornerSharpness.size());
        d.cornerVertexIndices = cornerVertices.data();
        d.cornerWeights = cornerSharpness.data();
        using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
        return std::unique_ptr<Far::TopologyRefiner>(
            Factory::Create(d, Factory::Options(scheme, options)));
    }
};

Sdc::Options OptionsOf(const ControlMesh& mesh) {
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(
        mesh.boundaryRule == BoundaryRule::None       ? Sdc::Options::VTX_BOUNDARY_NONE
        : mesh.boundaryRule == BoundaryRule::EdgeOnly ? Sdc::Options::VTX_BOUNDARY_EDGE_ONLY
                                                      : Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    options.SetCreasingMethod(mesh.creaseRule == CreaseRule::Chaikin
                                  ? Sdc::Options::CREASE_CHAIKIN
                                  : Sdc::Options::CREASE_UNIFORM);
    options.SetTriangleSubdivision(mesh.triangleRule == TriangleRule::Smooth
                                       ? Sdc::Options::TRI_SUB_SMOOTH
                                       : Sdc::Options::TRI_SUB_CATMARK);
    return options;
}

/// Adds the creases of a validated mesh: runs of two vertices with a sharpness each.
void AddCreases(const ControlMesh& mesh, Description* description) {
    for (size_t i = 0; i < mesh.creaseSharpnesses.size(); ++i) {
        description->AddCrease(mesh.creaseIndices[2 * i], mesh.creaseIndices[2 * i + 1],
                               mesh.creaseSharpnesses[i]);
    }
}

/// The faces around the vertices of the faces listed, in ascending order.
std::vector<int> FacesAndNeighbors(const Far::TopologyLevel& level, const std::vector<int>& faces) {
    std::vector<char> isIn(level.GetNumFaces(), 0), isVertexSeen(level.GetNumVertices(), 0);
    for (int face : faces) {
        for (Far::Index vertex : level.GetFaceVertices(face)) {
            if (isVertexSeen[vertex]) {
                continue;
            }
            isVertexSeen[vertex] = 1;
            for (Far::Index neighbor : level.GetVertexFaces(vertex)) {
                isIn[neighbor] = 1;
            }
        }
    }
    std::vector<int> result;
    for (int face = 0; face < level.GetNumFaces(); ++face) {
        if (isIn[face]) {
            result.push_back(face);
        }
    }
    return result;
}

/// A part of a level as a mesh of its own. Its cut edges become boundaries, which shape nothing
/// that descends from faces whose neighbours are all present.
struct Part {
    std::unique_ptr<Far::TopologyRefiner> refiner;
    std::vector<int> vertices;  ///< of the level, for each vertex of the part
};

Part ExtractPart(const Far::TopologyLevel& level, const std::vector<int>& faces,
                 Sdc::Options options) {
    Part part;
    Description description;
    std::vector<int> toPart(level.GetNumVertices(), -1);
    std::vector<char> isEdgeSeen(level.GetNumEdges(), 0);
    for (int face : faces) {
        const Far::ConstIndexArray vertices = level.GetFaceVertices(face);
        description.counts.push_back(vertices.size());
        for (Far::Index vertex : vertices) {
            if (toPart[vertex] < 0) {
                toPart[vertex] = description.vertexCount++;
                part.vertices.push_back(vertex);
                if (level.GetVertexSharpness(vertex) > 0) {
                    description.AddCorner(toPart[vertex], level.GetVertexSharpness(vertex));
                }
            }
            description.indices.push_back(toPart[vertex]);
        }
    }
    for (int face : faces) {
        for (Far::Index edge : level.GetFaceEdges(face)) {
            if (!isEdgeSeen[edge] && level.GetEdgeSharpness(edge) > 0) {
                isEdgeSeen[edge] = 1;
                const Far::ConstIndexArray ends = level.GetEdgeVertices(edge);
                description.AddCrease(toPart[ends[0]], toPart[ends[1]],
                                      level.GetEdgeSharpness(edge));
            }
        }
    }
    // Corners of the real boundary carry their sharpness already; those of the cut need none.
    options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    part.refiner = description.CreateRefiner(Sdc::SCHEME_CATMARK, options);
    return part;
}

Seams SeamsOf(const Part& part, const Seams& ofLevel) {
    Seams seams;
    for (size_t i = 0; i < part.vertices.size() && !ofLevel.empty(); ++i) {
        const auto found = ofLevel.find(part.vertices[i]);
        if (found != ofLevel.end()) {
            seams[static_cast<int>(i)] = found->second;
        }
    }
    return seams;
}

/// The child's vertices, from the corner of its cell that (0,0) of the parent's parameters is
/// nearest to on.
void OrderChild(const Far::ConstIndexArray& child, Far::Index cornerVertex, int cellCorner,
                int ordered[4]) {
    const int at = child.FindIndex(cornerVertex);
    for (int i = 0; i < 4; ++i) {
        ordered[i] = child[(at + i - cellCorner + 4) & 3];
    }
}

FaceOrigin ChildOrigin(const FaceOrigin& parent, int corner, bool parentIsQuad) {
    FaceOrigin origin = parent;
    ++origin.depth;
    if (!parentIsQuad) {
        origin.corner = corner;
        origin.isSubQuad = true;
        return origin;
    }
    origin.cellU = static_cast<uint16_t>(2 * parent.cellU + (corner == 1 || corner == 2));
    origin.cellV = static_cast<uint16_t>(2 * parent.cellV + (corner >= 2));
    return origin;
}

}  // namespace

void RefinementLevel::MaskRow::Clear() {
    vertices.clear();
    weights.clear();
}

void RefinementLevel::MaskRow::AddWithWeight(const MaskRow& row, float weight) {
    vertices.insert(vertices.end(), row.vertices.begin(), row.vertices.end());
    for (float w : row.weights) {
        weights.push_back(weight * w);
    }
}

void RefinementLevel::MaskRow::Merge() {
    std::vector<size_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [this](size_t a, size_t b) { return vertices[a] < vertices[b]; });
    MaskRow merged;
    for (size_t i : order) {
        if (merged.vertices.empty() || merged.vertices.back() != vertices[i]) {
            merged.vertices.push_back(vertices[i]);
            merged.weights.push_back(weights[i]);
        } else {
            merged.weights.back() += weights[i];
        }
    }
    *this = std::move(merged);
}

RefinementLevel::RefinementLevel(const ControlMesh& mesh, size_t pointCount, std::string* error) {
    CatchMessages();
    Description description;
    description.vertexCount = static_cast<int>(pointCount);
    std::vector<char> isHole(mesh.faceVertexCounts.size(), 0);
    for (int hole : mesh.holeIndices) {
        isHole[hole] = 1;
    }
    description.counts.reserve(mesh.faceVertexCounts.size());
    description.indices.reserve(mesh.faceVertexIndices.size());
    _origins.reserve(mesh.faceVertexCounts.size());
    size_t first = 0;
    for (size_t face = 0; face < mesh.faceVertexCounts.size(); ++face) {
        const int count = mesh.faceVertexCounts[face];
        const int* vertices = mesh.faceVertexIndices.data() + first;
        first += count;
        if (KeepsAllCorners(vertices, count)) {
            description.counts.push_back(count);
            description.indices.insert(description.indices.end(), vertices, vertices + count);
        } else {
            std::vector<int> kept = KeptCorners(vertices, count);
            if (kept.empty()) {
                continue;
            }
            description.counts.push_back(static_cast<int>(kept.size()));
            for (int corner : kept) {
                description.indices.push_back(vertices[corner]);
            }
            _keptCorners[FaceCount()] = std::move(kept);
        }
        _origins.push_back({static_cast<uint32_t>(face), 0, 0, 0, 0, false, isHole[face] == 0});
    }
    AddCreases(mesh, &description);
    for (size_t i = 0; i < mesh.cornerIndices.size(); ++i) {
        description.AddCorner(mesh.cornerIndices[i], mesh.cornerSharpnesses[i]);
    }
    currentError = error;
    _refiner = description.CreateRefiner(
        mesh.scheme == Scheme::Loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK, OptionsOf(mesh));
    currentError = nullptr;
    if (_refiner) {
        _NoteCage(mesh, pointCount);
    }
}

/// What is known of the cage once OpenSubdiv has its topology.
void RefinementLevel::_NoteCage(const ControlMesh& mesh, size_t pointCount) {
    for (int face = 0; face < FaceCount(); ++face) {
        // Without boundary interpolation OpenSubdiv drops the faces along the boundary.
        _origins[face].isVisible = _origins[face].isVisible && !Topology().IsFaceHole(face);
    }
    _vertexSharpness.reserve(Topology().GetNumVertices());
    for (int vertex = 0; vertex < Topology().GetNumVertices(); ++vertex) {
        _vertexSharpness.push_back(Topology().GetVertexSharpness(vertex));
    }
    for (size_t i = 0; i < mesh.seamIndices.size(); ++i) {
        _seams[mesh.seamIndices[i]].push_back(mesh.seamSharpnesses[i]);
    }
    _patchPoints.resize(pointCount);
    for (size_t i = 0; i < pointCount; ++i) {
        _patchPoints[i] = static_cast<uint32_t>(i);
    }
}

RefinementLevel::RefinementLevel(RefinementLevel* parent, const std::vector<int>& faces)
    : _parent(parent) {
    const Far::TopologyLevel parentLevel = parent->Topology();
    const Sdc::Options options = parent->_refiner->GetSchemeOptions();
    std::vector<int> partFaces = FacesAndNeighbors(parentLevel, faces);
    if (options.GetCreasingMethod() == Sdc::Options::CREASE_CHAIKIN) {
        // Edges of neighbours decay by what meets them at their far ends.
        partFaces = FacesAndNeighbors(parentLevel, partFaces);
    }
    Part part = ExtractPart(parentLevel, partFaces, options);
    if (!part.refiner) {
        return;
    }
    Far::TopologyRefiner::UniformOptions uniform(1);
    uniform.fullTopologyInLastLevel = true;
    part.refiner->RefineUniform(uniform);
    const Far::TopologyLevel coarse = part.refiner->GetLevel(0);
    const Far::TopologyLevel fine = part.refiner->GetLevel(1);

    std::vector<char> isRefined(parentLevel.GetNumFaces(), 0);
    for (int face : faces) {
        isRefined[face] = 1;
    }

    // The fine level as a mesh of its own, its faces turned so that their cells line up.
    Description description;
    description.vertexCount = fine.GetNumVertices();
    for (int face = 0; face < coarse.GetNumFaces(); ++face) {
        const FaceOrigin& origin = parent->Origin(partFaces[face]);
        const Far::ConstIndexArray corners = coarse.GetFaceVertices(face);
        const Far::ConstIndexArray children = coarse.GetFaceChildFaces(face);
        const bool isQuad = corners.size() == 4;
        for (int corner = 0; corner < corners.size(); ++corner) {
            int vertices[4];
            OrderChild(fine.GetFaceVertices(children[corner]),
                       coarse.GetVertexChildVertex(corners[corner]), isQuad ? corner : 0, vertices);
            description.counts.push_back(4);
            description.indices.insert(description.indices.end(), vertices, vertices + 4);
            FaceOrigin child = ChildOrigin(origin, corner, isQuad);
            child.isVisible = origin.isVisible && isRefined[partFaces[face]];
            const auto kept = parent->_keptCorners.find(partFaces[face]);
            if (!isQuad && kept != parent->_keptCorners.end()) {
                child.corner = kept->second[corner];
            }
            _origins.push_back(child);
            _outerEdges.push_back({partFaces[face], corner, isQuad ? corner : 0});
        }
    }
    SeamRefinement seams = RefineSeams(*part.refiner, SeamsOf(part, parent->_seams));
    for (int edge = 0; edge < fine.GetNumEdges(); ++edge) {
        const auto atSeam = seams.edgeSharpness.find(edge);
        const float sharpness =
            atSeam == seams.edgeSharpness.end() ? fine.GetEdgeSharpness(edge) : atSeam->second;
        if (sharpness > 0) {
            const Far::ConstIndexArray ends = fine.GetEdgeVertices(edge);
            description.AddCrease(ends[0], ends[1], sharpness);
        }
    }
    for (int vertex = 0; vertex < fine.GetNumVertices(); ++vertex) {
        _vertexSharpness.push_back(fine.GetVertexSharpness(vertex));
        if (fine.GetVertexSharpness(vertex) > 0) {
            description.AddCorner(vertex, fine.GetVertexSharpness(vertex));
        }
    }
    _refiner = description.CreateRefiner(Sdc::SCHEME_CATMARK, part.refiner->GetSchemeOptions());

    std::vector<MaskRow> identity(part.vertices.size());
    for (size_t i = 0; i < identity.size(); ++i) {
        identity[i] = {{part.vertices[i]}, {1}};
    }
    _rows.resize(fine.GetNumVertices());
    Far::PrimvarRefiner(*part.refiner).Interpolate(1, identity, _rows);
    for (const SeamRow& row : seams.rows) {
        _rows[row.vertex].Clear();
        for (const auto& [vertex, weight] : row.coarse) {
            _rows[row.vertex].AddWithWeight(identity[vertex], weight);
        }
        for (const auto& [vertex, weight] : row.facePoints) {
            _rows[row.vertex].AddWithWeight(_rows[vertex], weight);
        }
    }
    _seams = std::move(seams.seams);
    for (MaskRow& row : _rows) {
        row.Merge();
    }
    _patchPoints.assign(fine.GetNumVertices(), kNoPoint);
}

Stencil RefinementLevel::_ToStencil(const MaskRow& row, RefinementLevel* level, PatchTable* table) {
    Stencil stencil;
    stencil.weights = row.weights;
    for (int vertex : row.vertices) {
        stencil.indices.push_back(level->PatchPoint(vertex, table));
    }
    return stencil;
}

EdgePoints RefinementLevel::EdgeEnds(int face, int edge, PatchTable* table) {
    if (_parent) {
        const OuterEdges& outer = _outerEdges[face];
        if (edge == outer.corner) {
            return _parent->EdgeEnds(outer.parentFace, outer.parentCorner, table);
        }
        if (edge == ((outer.corner + 3) & 3)) {
            const int count = _parent->Topology().GetFaceVertices(outer.parentFace).size();
            return _parent->EdgeEnds(outer.parentFace, (outer.parentCorner + count - 1) % count,
                                     table);
        }
    }
    const auto vertices = Topology().GetFaceVertices(face);
    return {PatchPoint(vertices[edge], table),
            PatchPoint(vertices[(edge + 1) % vertices.size()], table)};
}

uint32_t RefinementLevel::PatchPoint(int vertex, PatchTable* table) {
    if (_patchPoints[vertex] == kNoPoint) {
        _patchPoints[vertex] = table->AddPoint(_ToStencil(_rows[vertex], _parent, table));
    }
    return _patchPoints[vertex];
}

uint32_t RefinementLevel::LimitPoint(int vertex, PatchTable* table) {
    if (_limitRows.empty()) {
        std::vector<MaskRow> identity(Topology().GetNumVertices());
        for (size_t i = 0; i < identity.size(); ++i) {
            identity[i] = {{static_cast<int>(i)}, {1}};
        }
        _limitRows.resize(identity.size());
        Far::PrimvarRefiner(*_refiner).Limit(identity, _limitRows);
        for (MaskRow& row : _limitRows) {
            row.Merge();
        }
        _limitPoints.assign(identity.size(), kNoPoint);
    }
    if (_limitPoints[vertex] == kNoPoint) {
        _limitPoints[vertex] = table->AddPoint(_ToStencil(_limitRows[vertex], this, table));
    }
    return _limitPoints[vertex];
}

}  // namespace cc
