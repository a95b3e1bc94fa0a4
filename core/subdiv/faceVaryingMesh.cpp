#include "core/subdiv/faceVaryingMesh.h"

#include <algorithm>
#include <utility>

#include <opensubdiv/sdc/crease.h>

#include "core/subdiv/refinementLevel.h"
#include "core/subdiv/ringTags.h"

namespace cc {
namespace {

using OpenSubdiv::Far::ConstIndexArray;
using OpenSubdiv::Far::ConstLocalIndexArray;
using OpenSubdiv::Far::Index;
using OpenSubdiv::Far::TopologyLevel;
using OpenSubdiv::Sdc::Crease;

/// The faces around a vertex of the cage that have the same value there.
struct Span {
    int faceCount = 0;
    /// Edges between two of the faces along which values do not split.
    int innerEdgeCount = 0;
    bool hasSharpEdge = false;
    /// Of the inner edges that are semi-sharp.
    RingTags::Sharpnesses sharpnesses;

    /// True if the value cannot be that of a smooth boundary: the faces are several fans, or an
    /// infinitely sharp edge runs through them.
    bool IsDisjoint() const { return hasSharpEdge || faceCount - innerEdgeCount > 1; }
};

/// Sharpness of a corner that is one for as long as another span has semi-sharp edges. In the step
/// in which the last of them go, it counts as much as they do; or wholly, if an edge along the seam
/// stays semi-sharp.
/// @param other  the edges of the other span, and those along the seam
float DependentSharpness(RingTags other) {
    const auto isSharp = [](float sharpness) { return sharpness > 0; };
    for (float steps = 0;; ++steps) {
        const RingTags decayed = other.Decayed();
        if (std::none_of(decayed.edgeSharpness.begin(), decayed.edgeSharpness.end(), isSharp)) {
            const bool staysAlongSeam =
                std::any_of(decayed.seamSharpness.begin(), decayed.seamSharpness.end(), isSharp);
            return steps + (staysAlongSeam ? 1 : other.FractionalWeight(decayed));
        }
        other = decayed;
    }
}

/// Follows OpenSubdiv's analysis of a face-varying channel (Vtr::internal::FVarLevel), vertex by
/// vertex of the cage.
class FaceVaryingMeshBuilder {
  public:
    FaceVaryingMeshBuilder(const ControlMesh& cage, size_t pointCount,
                           const std::vector<int>& valueIndices)
        : _cage(cage), _valueIndices(valueIndices), _base(cage, pointCount, &_result.error) {}

    FaceVaryingMesh Build() {
        if (!_base.IsValid()) {
            return std::move(_result);
        }
        const TopologyLevel level = _base.Topology();
        _SetRules();
        _PlaceCorners(level);
        for (Index vertex = 0; vertex < level.GetNumVertices(); ++vertex) {
            _AddVertices(level, vertex);
        }
        _WriteFaces();
        _isSplit.resize(level.GetNumEdges());
        for (Index edge = 0; edge < level.GetNumEdges(); ++edge) {
            _isSplit[edge] = _IsSplit(level, edge);
            _AddCreases(level, edge);
        }
        for (Index vertex = 0; vertex < level.GetNumVertices(); ++vertex) {
            _AddCorners(level, vertex);
            if (_cage.creaseRule == CreaseRule::Chaikin) {
                _AddSeams(level, vertex);
            }
        }
        return std::move(_result);
    }

  private:
    void _SetRules() {
        ControlMesh& mesh = _result.mesh;
        mesh.scheme = _cage.scheme;
        mesh.creaseRule = _cage.creaseRule;
        mesh.triangleRule = _cage.triangleRule;
        // What is a corner is so by its sharpness, and faces that the cage's rule hides are holes.
        mesh.boundaryRule = BoundaryRule::EdgeOnly;
        mesh.faceVertexCounts = _cage.faceVertexCounts;
    }

    /// Finds the authored corners of the level's faces.
    void _PlaceCorners(const TopologyLevel& level) {
        std::vector<int> firsts;
        int first = 0;
        for (int count : _cage.faceVertexCounts) {
            firsts.push_back(first);
            first += count;
        }
        for (int face = 0; face < level.GetNumFaces(); ++face) {
            const uint32_t authored = _base.Origin(face).face;
            _firstCorner.push_back(static_cast<int>(_corners.size()));
            for (int kept : KeptCorners(&_cage.faceVertexIndices[firsts[authored]],
                                        _cage.faceVertexCounts[authored])) {
                _corners.push_back(firsts[authored] + kept);
            }
        }
        _vertexAt.resize(_corners.size());
    }

    /// Adds a vertex for each value that meets at a vertex of the cage.
    void _AddVertices(const TopologyLevel& level, Index vertex) {
        const ConstIndexArray faces = level.GetVertexFaces(vertex);
        const ConstLocalIndexArray places = level.GetVertexFaceLocalIndices(vertex);
        _firstVertex.push_back(_VertexCount());
        std::vector<int>& values = _result.values;
        int latest = -1;
        for (int i = 0; i < faces.size(); ++i) {
            const int at = _firstCorner[faces[i]] + places[i];
            const int value = _valueIndices[_corners[at]];
            if (latest < 0 || value != values[latest]) {
                latest = _FindValue(value, _firstVertex.back(), !level.IsVertexNonManifold(vertex));
                if (latest == _VertexCount()) {
                    values.push_back(value);
                }
            }
            _vertexAt[at] = latest;
        }
    }

    /// Finds a value, other than the one before, among those that were met around a vertex. Like
    /// OpenSubdiv, where only two were, takes the second for a new one when it comes again.
    int _FindValue(int value, int first, bool isOrdered) const {
        const auto begin = _result.values.begin() + first, end = _result.values.end();
        const bool isAgain = isOrdered && end - begin == 2 && value == begin[1];
        return static_cast<int>((isAgain ? end : std::find(begin, end, value)) -
                                _result.values.begin());
    }

    int _VertexCount() const { return static_cast<int>(_result.values.size()); }

    /// Corners that were left out of a face repeat the one before them, to be left out again.
    void _WriteFaces() {
        ControlMesh& mesh = _result.mesh;
        mesh.faceVertexIndices.assign(_cage.faceVertexIndices.size(), -1);
        for (size_t i = 0; i < _corners.size(); ++i) {
            mesh.faceVertexIndices[_corners[i]] = _vertexAt[i];
        }
        std::vector<char> isVisible(_cage.faceVertexCounts.size(), 0);
        for (int face = 0; face < _base.FaceCount(); ++face) {
            isVisible[_base.Origin(face).face] = _base.Origin(face).isVisible;
        }
        int* vertices = mesh.faceVertexIndices.data();
        for (int face = 0; face < mesh.FaceCount(); ++face) {
            const int count = mesh.faceVertexCounts[face];
            if (!isVisible[face]) {
                mesh.holeIndices.push_back(face);
            }
            int* const last = std::find_if(std::make_reverse_iterator(vertices + count),
                                           std::make_reverse_iterator(vertices),
                                           [](int vertex) { return vertex >= 0; })
                                  .base();
            int previous = last == vertices ? 0 : last[-1];
            for (int i = 0; i < count; ++i) {
                vertices[i] = previous = vertices[i] < 0 ? previous : vertices[i];
            }
            vertices += count;
        }
    }

    /// The vertices of the new mesh at the ends of an edge of one of its faces.
    std::pair<int, int> _Ends(const TopologyLevel& level, Index edge, int i) const {
        const Index face = level.GetEdgeFaces(edge)[i];
        const int place = level.GetEdgeFaceLocalIndices(edge)[i];
        const ConstIndexArray vertices = level.GetFaceVertices(face);
        const int first = _firstCorner[face];
        const int a = _vertexAt[first + place],
                  b = _vertexAt[first + (place + 1) % vertices.size()];
        return vertices[place] == level.GetEdgeVertices(edge)[0] ? std::make_pair(a, b)
                                                                 : std::make_pair(b, a);
    }

    bool _IsSplit(const TopologyLevel& level, Index edge) const {
        for (int i = 1; i < level.GetEdgeFaces(edge).size(); ++i) {
            if (_Ends(level, edge, i) != _Ends(level, edge, 0)) {
                return true;
            }
        }
        return false;
    }

    /// Creases shape values as they shape points; where faces have come apart there is a boundary.
    void _AddCreases(const TopologyLevel& level, Index edge) {
        const int faceCount = level.GetEdgeFaces(edge).size();
        const float sharpness = level.GetEdgeSharpness(edge);
        if (sharpness <= 0 || faceCount < 2 || (faceCount == 2 && _isSplit[edge])) {
            return;
        }
        ControlMesh& mesh = _result.mesh;
        for (int i = 0; i < (_isSplit[edge] ? faceCount : 1); ++i) {
            const std::pair<int, int> ends = _Ends(level, edge, i);
            mesh.creaseIndices.insert(mesh.creaseIndices.end(), {ends.first, ends.second});
            mesh.creaseLengths.push_back(2);
            mesh.creaseSharpnesses.push_back(sharpness);
        }
    }

    /// Under Chaikin's rule, edges of the cage decay together at a vertex, whatever values they are
    /// between.
    void _AddSeams(const TopologyLevel& level, Index vertex) {
        ControlMesh& mesh = _result.mesh;
        for (Index edge : level.GetVertexEdges(vertex)) {
            const float sharpness = level.GetEdgeSharpness(edge);
            if (!Crease::IsSemiSharp(sharpness)) {
                continue;
            }
            const int own = _isSplit[edge] ? -1 : _ValueAt(level, vertex, edge);
            for (int i = 0; i < _ValueCount(vertex); ++i) {
                if (_firstVertex[vertex] + i != own) {
                    mesh.seamIndices.push_back(_firstVertex[vertex] + i);
                    mesh.seamSharpnesses.push_back(sharpness);
                }
            }
        }
    }

    /// The vertex of the new mesh at a vertex of the cage, on an edge that is not split.
    int _ValueAt(const TopologyLevel& level, Index vertex, Index edge) const {
        const std::pair<int, int> ends = _Ends(level, edge, 0);
        return level.GetEdgeVertices(edge)[0] == vertex ? ends.first : ends.second;
    }

    void _AddCorner(int vertex, float sharpness) {
        if (sharpness > 0) {
            _result.mesh.cornerIndices.push_back(vertex);
            _result.mesh.cornerSharpnesses.push_back(std::min(sharpness, 10.0f));
        }
    }

    int _ValueCount(Index vertex) const {
        const size_t next = static_cast<size_t>(vertex) + 1;
        return (next < _firstVertex.size() ? _firstVertex[next] : _VertexCount()) -
               _firstVertex[vertex];
    }

    /// True if the rule may make values at a vertex differ in kind from its point.
    bool _IsMismatch(const TopologyLevel& level, Index vertex) const {
        for (Index edge : level.GetVertexEdges(vertex)) {
            if (_isSplit[edge]) {
                return true;
            }
        }
        const FaceVaryingRule rule = _cage.faceVaryingRule;
        return level.IsVertexBoundary(vertex) &&
               (rule == FaceVaryingRule::Boundaries ||
                (rule != FaceVaryingRule::None && level.GetVertexFaces(vertex).size() == 1));
    }

    void _AddCorners(const TopologyLevel& level, Index vertex) {
        const int first = _firstVertex[vertex], count = _ValueCount(vertex);
        const bool isMismatch = _IsMismatch(level, vertex);
        if (isMismatch && _AreAllSharp(level, vertex, count)) {
            for (int i = 0; i < count; ++i) {
                _AddCorner(first + i, Crease::SHARPNESS_INFINITE);
            }
        } else if (isMismatch) {
            _AddSpanCorners(level, vertex);
        } else {
            for (int i = 0; i < count; ++i) {
                _AddCorner(first + i, level.GetVertexSharpness(vertex));
            }
        }
    }

    bool _DependsOnOthers() const {
        return _cage.faceVaryingRule == FaceVaryingRule::CornersPlus1 ||
               _cage.faceVaryingRule == FaceVaryingRule::CornersPlus2;
    }

    /// True if the rule makes all values at a vertex corners, whatever their faces are.
    bool _AreAllSharp(const TopologyLevel& level, Index vertex, int count) const {
        const bool isDart = count == 1 && !level.IsVertexBoundary(vertex);
        return _cage.faceVaryingRule == FaceVaryingRule::Boundaries ||
               Crease::IsInfinite(level.GetVertexSharpness(vertex)) ||
               level.IsVertexNonManifold(vertex) || (_DependsOnOthers() && count > 2) ||
               (_cage.faceVaryingRule == FaceVaryingRule::CornersPlus2 && isDart);
    }

    std::vector<Span> _GatherSpans(const TopologyLevel& level, Index vertex) const {
        const int first = _firstVertex[vertex];
        std::vector<Span> spans(_ValueCount(vertex));
        const ConstIndexArray faces = level.GetVertexFaces(vertex);
        const ConstLocalIndexArray places = level.GetVertexFaceLocalIndices(vertex);
        for (int i = 0; i < faces.size(); ++i) {
            ++spans[_vertexAt[_firstCorner[faces[i]] + places[i]] - first].faceCount;
        }
        for (Index edge : level.GetVertexEdges(vertex)) {
            const float sharpness = level.GetEdgeSharpness(edge);
            if (_isSplit[edge] || level.GetEdgeFaces(edge).size() < 2) {
                continue;
            }
            Span& span = spans[_ValueAt(level, vertex, edge) - first];
            ++span.innerEdgeCount;
            span.hasSharpEdge = span.hasSharpEdge || Crease::IsInfinite(sharpness);
            if (Crease::IsSemiSharp(sharpness)) {
                span.sharpnesses.push_back(sharpness);
            }
        }
        return spans;
    }

    /// The semi-sharp edges of a span, and those along its seam.
    RingTags _TagsOf(const TopologyLevel& level, Index vertex, const Span& span) const {
        RingTags tags;
        tags.decay = _cage.creaseRule == CreaseRule::Chaikin ? SharpnessDecay::Chaikin
                                                             : SharpnessDecay::Uniform;
        tags.edgeSharpness = span.sharpnesses;
        tags.farSharpness.assign(tags.edgeSharpness.size(), 0);
        for (Index edge : level.GetVertexEdges(vertex)) {
            if (_isSplit[edge] && Crease::IsSemiSharp(level.GetEdgeSharpness(edge))) {
                tags.seamSharpness.push_back(level.GetEdgeSharpness(edge));
            }
        }
        return tags;
    }

    void _AddSpanCorners(const TopologyLevel& level, Index vertex) {
        const std::vector<Span> spans = _GatherSpans(level, vertex);
        const bool isPair = _DependsOnOthers() && spans.size() == 2;
        const bool sharpenBoth =
            isPair && std::any_of(spans.begin(), spans.end(), [this](const Span& span) {
                return span.IsDisjoint() ||
                       (span.faceCount == 1 &&
                        _cage.faceVaryingRule == FaceVaryingRule::CornersPlus2);
            });
        for (size_t i = 0; i < spans.size(); ++i) {
            const bool isCorner =
                sharpenBoth || spans[i].IsDisjoint() ||
                (spans[i].faceCount == 1 && _cage.faceVaryingRule != FaceVaryingRule::None);
            float sharpness =
                isCorner ? Crease::SHARPNESS_INFINITE : level.GetVertexSharpness(vertex);
            if (isPair && sharpness <= 0 && spans[i].sharpnesses.size() == 0 &&
                spans[1 - i].sharpnesses.size() > 0) {
                sharpness = DependentSharpness(_TagsOf(level, vertex, spans[1 - i]));
            }
            _AddCorner(_firstVertex[vertex] + static_cast<int>(i), sharpness);
        }
    }

    const ControlMesh& _cage;
    const std::vector<int>& _valueIndices;
    FaceVaryingMesh _result;
    RefinementLevel _base;

    /// Face-vertices of the level's faces, face by face: which authored one each is.
    std::vector<int> _corners;
    std::vector<int> _firstCorner;
    /// For each of them, its vertex of the new mesh.
    std::vector<int> _vertexAt;
    /// By vertex of the cage: the first of its vertices in the new mesh.
    std::vector<int> _firstVertex;
    /// By edge of the cage: whether its faces have come apart.
    std::vector<char> _isSplit;
};

/// True if all faces that make patches have four corners.
bool HasQuadsOnly(const ControlMesh& mesh) {
    const int* face = mesh.faceVertexIndices.data();
    for (int count : mesh.faceVertexCounts) {
        const size_t kept = KeptCorners(face, count).size();
        if (kept != 0 && kept != 4) {
            return false;
        }
        face += count;
    }
    return true;
}

}  // namespace

bool IsFaceVaryingBilinear(const ControlMesh& mesh, bool isIndexed) {
    const bool isLoop = mesh.scheme == Scheme::Loop;
    if ((mesh.scheme != Scheme::CatmullClark && !isLoop) ||
        mesh.faceVaryingRule == FaceVaryingRule::All) {
        return true;
    }
    // Where no two face-vertices share a value, each face is a mesh of one face, all sharp corners:
    // bilinear if it is a quad, but smooth inside if it is not; and linear under the Loop scheme.
    return !isIndexed && mesh.faceVaryingRule != FaceVaryingRule::None &&
           (isLoop || HasQuadsOnly(mesh));
}

FaceVaryingMesh MakeFaceVaryingMesh(const ControlMesh& mesh, size_t pointCount,
                                    const std::vector<int>& valueIndices) {
    return FaceVaryingMeshBuilder(mesh, pointCount, valueIndices).Build();
}

}  // namespace cc
