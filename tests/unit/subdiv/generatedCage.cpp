#include "tests/unit/subdiv/generatedCage.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>

#include <rapidcheck.h>

#include "tests/repeats.h"
#include "tests/unit/subdiv/cageKit.h"
#include "tests/unit/subdiv/oracleTopology.h"

namespace cc::test {
namespace {

/// Keeps the cost of a cage within bounds, whatever the steps do.
constexpr size_t kMaxFaces = 80;

Cage Shape(int shape, int size) {
    switch (shape) {
        case 1: return Cube();
        case 2: return Fan(2 + size);
        case 3: return Tetrahedron();
        case 4: return Drum(3 + size);
        case 5: return Torus(3 + size % 4, 3);
        default: return Sheet(1 + size % 4);
    }
}
constexpr int kShapes = 6;

struct Edge {
    int from, to;
};

/// A cage while steps change it: a list of faces, with tags.
class CageBuilder {
  public:
    explicit CageBuilder(const Cage& start) { _AddShape(start, {}); }

    void Apply(const CageStep& step) {
        switch (step.change) {
            case CageChange::AddTriangle: return _AddOnEdge(step, 1);
            case CageChange::AddQuad: return _AddOnEdge(step, 2);
            case CageChange::AddPolygon: return _AddOnEdge(step, 3 + step.c % 4);
            case CageChange::FillNotch: return _FillNotch(step);
            case CageChange::FillHole: return _FillHole(step);
            case CageChange::SplitFace: return _SplitFace(step);
            case CageChange::SplitEdge: return _SplitEdge(step);
            case CageChange::RemoveFace: return _RemoveFace(step);
            case CageChange::AddPiece: return _AddPiece(step);
            case CageChange::JoinPoints: return _JoinPoints(step);
            case CageChange::MergePoints: return _MergePoints(step);
            case CageChange::RepeatFace: return _RepeatFace(step);
            case CageChange::CollapseEdge: return _CollapseEdge(step);
            case CageChange::AddPoint: _AddPoint({9, -7, 8}); return;
            case CageChange::Crease: return _AddCrease(step);
            case CageChange::Corner: AddCorner(&_tags, _EdgeOf(step).from, step.sharpness); return;
            case CageChange::Hole: _tags.mesh.holeIndices.push_back(_FaceOf(step.a)); return;
        }
    }

    /// @param sharpnessByEdge  each edge of a crease gets another sharpness
    Cage Finish(bool sharpnessByEdge) const {
        Cage cage = _tags;
        for (const std::vector<int>& face : _faces) {
            AddFace(&cage, face);
        }
        cage.points = _points;
        if (sharpnessByEdge) {
            std::vector<float> sharpnesses;
            for (size_t crease = 0; crease < cage.mesh.creaseLengths.size(); ++crease) {
                for (int edge = 1; edge < cage.mesh.creaseLengths[crease]; ++edge) {
                    sharpnesses.push_back(cage.mesh.creaseSharpnesses[crease] /
                                          static_cast<float>(edge));
                }
            }
            cage.mesh.creaseSharpnesses = sharpnesses;
        }
        return cage;
    }

  private:
    size_t _FaceOf(int number) const { return static_cast<size_t>(number) % _faces.size(); }
    int _PointOf(int number) const { return number % static_cast<int>(_points.size()); }
    Edge _EdgeOf(const CageStep& step) const {
        const std::vector<int>& face = _faces[_FaceOf(step.a)];
        const size_t corner = static_cast<size_t>(step.b) % face.size();
        return {face[corner], face[(corner + 1) % face.size()]};
    }

    int _AddPoint(const Vec3f& near) {
        // Somewhere near, the same for the same number.
        const float i = static_cast<float>(_points.size());
        _points.push_back(near +
                          Vec3f{std::sin(2.1f * i), std::cos(1.3f * i), std::sin(0.7f * i + 1)});
        return static_cast<int>(_points.size()) - 1;
    }

    void _AddFace(const std::vector<int>& face) {
        if (_faces.size() < kMaxFaces) {
            _faces.push_back(face);
        }
    }

    /// Adds a shape; those of its points that stand in the list are points that are there already.
    void _AddShape(const Cage& shape, const std::map<int, int>& shared) {
        std::vector<int> numbers;
        const Vec3f aside = Vec3f{0.3f, -0.2f, 0.5f} * static_cast<float>(_faces.size());
        for (int i = 0; i < static_cast<int>(shape.points.size()); ++i) {
            const auto found = shared.find(i);
            numbers.push_back(found != shared.end() ? found->second
                                                    : static_cast<int>(_points.size()));
            if (found == shared.end()) {
                _points.push_back(shape.points[i] + aside);
            }
        }
        const int* vertex = shape.mesh.faceVertexIndices.data();
        for (int count : shape.mesh.faceVertexCounts) {
            std::vector<int> face;
            for (int i = 0; i < count; ++i) {
                face.push_back(numbers[*vertex++]);
            }
            _AddFace(face);
        }
    }

    void _AddOnEdge(const CageStep& step, int newPoints) {
        const Edge edge = _EdgeOf(step);
        std::vector<int> face{edge.to, edge.from};
        for (int i = 0; i < newPoints; ++i) {
            face.push_back(_AddPoint((_points[edge.from] + _points[edge.to]) * 0.5f));
        }
        _AddFace(face);
    }

    /// Edges that have a face on one side only, in the direction of that face.
    std::vector<Edge> _Boundary() const {
        std::map<std::pair<int, int>, int> uses;
        for (const std::vector<int>& face : _faces) {
            for (size_t i = 0; i < face.size(); ++i) {
                ++uses[{face[i], face[(i + 1) % face.size()]}];
            }
        }
        std::vector<Edge> boundary;
        for (const auto& [ends, count] : uses) {
            if (uses.count({ends.second, ends.first}) == 0) {
                boundary.push_back({ends.first, ends.second});
            }
        }
        return boundary;
    }

    static const Edge* _EdgeFrom(const std::vector<Edge>& edges, int vertex) {
        const auto found = std::find_if(edges.begin(), edges.end(),
                                        [vertex](const Edge& e) { return e.from == vertex; });
        return found == edges.end() ? nullptr : &*found;
    }

    void _FillNotch(const CageStep& step) {
        const std::vector<Edge> boundary = _Boundary();
        if (boundary.empty()) {
            return;
        }
        const Edge& first = boundary[step.a % boundary.size()];
        const Edge* second = _EdgeFrom(boundary, first.to);
        if (second == nullptr || second->to == first.from) {
            return;
        }
        std::vector<int> face{second->to, first.to, first.from};
        if (step.c % 2 == 0) {
            face.push_back(_AddPoint((_points[first.from] + _points[second->to]) * 0.5f));
        }
        _AddFace(face);
    }

    void _FillHole(const CageStep& step) {
        const std::vector<Edge> boundary = _Boundary();
        if (boundary.empty()) {
            return;
        }
        const Edge* edge = &boundary[step.a % boundary.size()];
        const int start = edge->from;
        std::vector<int> face{start};
        while (edge != nullptr && edge->to != start && face.size() < boundary.size()) {
            face.insert(face.begin(), edge->to);
            edge = _EdgeFrom(boundary, edge->to);
        }
        if (edge != nullptr && edge->to == start) {
            _AddFace(face);
        }
    }

    void _SplitFace(const CageStep& step) {
        const std::vector<int> face = _faces[_FaceOf(step.a)];
        _faces.erase(_faces.begin() + static_cast<ptrdiff_t>(_FaceOf(step.a)));
        const int center = _AddPoint(_points[face[0]]);
        for (size_t i = 0; i < face.size(); ++i) {
            _faces.push_back({face[i], face[(i + 1) % face.size()], center});
        }
    }

    void _SplitEdge(const CageStep& step) {
        const Edge edge = _EdgeOf(step);
        const int middle = _AddPoint((_points[edge.from] + _points[edge.to]) * 0.5f);
        for (std::vector<int>& face : _faces) {
            for (size_t i = 0; i < face.size(); ++i) {
                const int a = face[i], b = face[(i + 1) % face.size()];
                if (std::minmax(a, b) == std::minmax(edge.from, edge.to)) {
                    face.insert(face.begin() + static_cast<ptrdiff_t>(i) + 1, middle);
                    ++i;
                }
            }
        }
    }

    void _RemoveFace(const CageStep& step) {
        if (_faces.size() > 1) {
            _faces.erase(_faces.begin() + static_cast<ptrdiff_t>(_FaceOf(step.a)));
        }
    }

    void _AddPiece(const CageStep& step) {
        const Cage piece = Shape(step.c % kShapes, step.b % 3);
        const Edge edge = _EdgeOf(step);
        switch (step.c / kShapes % 3) {
            case 0: return _AddShape(piece, {{0, edge.from}});
            case 1: return _AddShape(piece, {{0, edge.from}, {1, edge.to}});
            default: return _AddShape(piece, {});
        }
    }

    void _JoinPoints(const CageStep& step) {
        const Edge edge = _EdgeOf(step);
        std::vector<int> face{edge.from, edge.to, _PointOf(step.c)};
        if (step.b % 2 == 0) {
            face.push_back(_PointOf(step.a));
        }
        _AddFace(face);
    }

    void _MergePoints(const CageStep& step) {
        for (std::vector<int>& face : _faces) {
            std::replace(face.begin(), face.end(), _PointOf(step.a), _PointOf(step.b));
        }
    }

    void _RepeatFace(const CageStep& step) {
        std::vector<int> face = _faces[_FaceOf(step.a)];
        if (step.b % 2 == 1) {
            std::reverse(face.begin(), face.end());
        }
        _AddFace(face);
    }

    void _CollapseEdge(const CageStep& step) {
        std::vector<int>& face = _faces[_FaceOf(step.a)];
        const size_t corner = static_cast<size_t>(step.b) % face.size();
        face[corner] = face[(corner + 1) % face.size()];
    }

    void _AddCrease(const CageStep& step) {
        Edge edge = _EdgeOf(step);
        std::vector<int> run{edge.from, edge.to};
        for (int more = step.c % 4; more > 0; --more) {
            // On along some edge that leaves the end.
            for (const std::vector<int>& face : _faces) {
                const auto at = std::find(face.begin(), face.end(), run.back());
                const int next = at == face.end()       ? -1
                                 : at + 1 == face.end() ? face.front()
                                                        : *(at + 1);
                if (next >= 0 && std::find(run.begin(), run.end(), next) == run.end()) {
                    run.push_back(next);
                    break;
                }
            }
        }
        AddCrease(&_tags, run, step.sharpness);
    }

    std::vector<std::vector<int>> _faces;
    std::vector<Vec3f> _points;
    /// Creases, corners and holes only.
    Cage _tags;
};

/// True if semi-sharp creases follow Chaikin's rule at faces that BoundaryRule::None leaves out.
/// Far does not refine such faces, and from the first step on it takes their edges for none of
/// those by which the others decay; its surface is not the one that it has beside the same faces
/// left in.
bool HasChaikinCreaseAtLeftOutFace(Cage cage) {
    if (cage.mesh.creaseRule != CreaseRule::Chaikin ||
        cage.mesh.boundaryRule != BoundaryRule::None) {
        return false;
    }
    ValidateControlMesh(&cage.mesh, cage.points.size());
    const OracleTopology topology(cage.mesh, cage.points.size());
    if (topology.Refiner() == nullptr) {
        return false;
    }
    const auto level = topology.Refiner()->GetLevel(0);
    for (int face = 0; face < level.GetNumFaces(); ++face) {
        for (const int vertex : level.GetFaceVertices(face)) {
            for (const int edge : level.GetVertexEdges(vertex)) {
                const float sharpness = level.GetEdgeSharpness(edge);
                if (level.IsFaceHole(face) && sharpness > 0 && sharpness < 10) {
                    return true;
                }
            }
        }
    }
    return false;
}

/// Any number below a count. RapidCheck by itself takes small ones only, until its size is 100.
rc::Gen<int> Below(int count) {
    return rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, count));
}

/// One of some values, of which shrinking prefers the first.
template <typename T>
rc::Gen<T> OneOf(std::vector<T> values) {
    const int count = static_cast<int>(values.size());
    return rc::gen::map(Below(count), [values = std::move(values)](int i) { return values[i]; });
}

rc::Gen<CageStep> Steps() {
    using C = CageChange;
    // By how often.
    const std::vector<C> changes{
        C::AddQuad,      C::AddQuad,   C::AddTriangle, C::AddPolygon,  C::FillNotch,
        C::FillNotch,    C::FillNotch, C::FillHole,    C::SplitFace,   C::SplitEdge,
        C::RemoveFace,   C::AddPiece,  C::JoinPoints,  C::MergePoints, C::RepeatFace,
        C::CollapseEdge, C::AddPoint,  C::Crease,      C::Crease,      C::Crease,
        C::Crease,       C::Crease,    C::Corner,      C::Corner,      C::Hole};
    // Not up to 10: features of a size of 2^-10 have normals that floats cannot tell to 0.05
    // degrees.
    return rc::gen::build<CageStep>(
        rc::gen::set(&CageStep::change, OneOf(changes)), rc::gen::set(&CageStep::a, Below(97)),
        rc::gen::set(&CageStep::b, Below(97)), rc::gen::set(&CageStep::c, Below(97)),
        rc::gen::set(&CageStep::sharpness,
                     OneOf<float>({10, 1, 2, 0.5f, 0.3f, 1.5f, 2.7f, 4, 25, 6.8f})));
}

rc::Gen<CageRecipe> Recipes() {
    return rc::gen::build<CageRecipe>(
        rc::gen::set(&CageRecipe::shape, Below(kShapes)),
        rc::gen::set(&CageRecipe::size, Below(20)),
        rc::gen::set(&CageRecipe::boundaryRule,
                     OneOf<BoundaryRule>({BoundaryRule::EdgeAndCorner, BoundaryRule::EdgeOnly,
                                          BoundaryRule::None})),
        rc::gen::set(&CageRecipe::creaseRule,
                     OneOf<CreaseRule>({CreaseRule::Uniform, CreaseRule::Chaikin})),
        rc::gen::set(&CageRecipe::triangleRule,
                     OneOf<TriangleRule>({TriangleRule::CatmullClark, TriangleRule::Smooth})),
        rc::gen::set(&CageRecipe::leftHanded, OneOf<bool>({false, true})),
        rc::gen::set(&CageRecipe::sharpnessByEdge, OneOf<bool>({false, true})),
        rc::gen::set(&CageRecipe::steps, rc::gen::container<std::vector<CageStep>>(Steps())));
}

template <typename T>
std::string List(const T* values, size_t count) {
    std::ostringstream out;
    out << "{";
    for (size_t i = 0; i < count; ++i) {
        out << (i > 0 ? ", " : "") << values[i];
    }
    out << "}";
    return out.str();
}

}  // namespace

/// RapidCheck shows what failed by this.
void showValue(const CageRecipe& recipe, std::ostream& out) { out << ToCode(BuildCage(recipe)); }

Cage BuildCage(const CageRecipe& recipe) {
    CageBuilder builder(Shape(recipe.shape, recipe.size));
    for (const CageStep& step : recipe.steps) {
        builder.Apply(step);
    }
    Cage cage = Named(builder.Finish(recipe.sharpnessByEdge), "generated");
    cage.mesh.boundaryRule = recipe.boundaryRule;
    cage.mesh.creaseRule = recipe.creaseRule;
    cage.mesh.triangleRule = recipe.triangleRule;
    cage.mesh.leftHanded = recipe.leftHanded;
    if (HasChaikinCreaseAtLeftOutFace(cage)) {
        cage.mesh.boundaryRule = BoundaryRule::EdgeOnly;
    }
    return cage;
}

std::string ToCode(const Cage& cage) {
    const ControlMesh& mesh = cage.mesh;
    std::ostringstream out;
    out << "Cage cage = FromFaces(\"generated\", {";
    const int* vertices = mesh.faceVertexIndices.data();
    for (int face = 0; face < mesh.FaceCount(); ++face) {
        out << (face > 0 ? ", " : "") << List(vertices, mesh.faceVertexCounts[face]);
        vertices += mesh.faceVertexCounts[face];
    }
    out << "});\ncage.points = {";
    for (const Vec3f& p : cage.points) {
        out << "{" << p.x << ", " << p.y << ", " << p.z << "}, ";
    }
    const auto assign = [&out](const char* array, const auto& values) {
        if (!values.empty()) {
            out << "cage.mesh." << array << " = " << List(values.data(), values.size()) << ";\n";
        }
    };
    out << "};\n";
    assign("creaseIndices", mesh.creaseIndices);
    assign("creaseLengths", mesh.creaseLengths);
    assign("creaseSharpnesses", mesh.creaseSharpnesses);
    assign("cornerIndices", mesh.cornerIndices);
    assign("cornerSharpnesses", mesh.cornerSharpnesses);
    assign("holeIndices", mesh.holeIndices);
    const char* const boundaries[] = {"None", "EdgeOnly", "EdgeAndCorner"};
    out << "cage.mesh.boundaryRule = BoundaryRule::"
        << boundaries[static_cast<int>(mesh.boundaryRule)] << ";\n";
    if (mesh.creaseRule == CreaseRule::Chaikin) {
        out << "cage.mesh.creaseRule = CreaseRule::Chaikin;\n";
    }
    if (mesh.triangleRule == TriangleRule::Smooth) {
        out << "cage.mesh.triangleRule = TriangleRule::Smooth;\n";
    }
    if (mesh.leftHanded) {
        out << "cage.mesh.leftHanded = true;\n";
    }
    return out.str();
}

void ExpectForGeneratedCages(const std::string& description,
                             const std::function<std::string(const Cage&)>& property) {
    const std::string count = std::to_string(Repeats(50));
    setenv("RC_PARAMS", ("seed=20 max_size=30 max_success=" + count).c_str(), 0);
    EXPECT_TRUE(rc::check(description, [&property] {
        const CageRecipe recipe = *Recipes();
        const std::string failure = property(BuildCage(recipe));
        if (!failure.empty()) {
            RC_FAIL(failure);
        }
    }));
}

}  // namespace cc::test
