#include "tests/unit/subdiv/polygonOracle.h"

#include "core/subdiv/triangulation.h"

namespace cc::test {
namespace {

class PolygonOracle : public LimitOracle {
  public:
    PolygonOracle(const ControlMesh& mesh, const std::vector<Vec3f>& points) {
        const int* vertices = mesh.faceVertexIndices.data();
        for (const int count : mesh.faceVertexCounts) {
            Polygon polygon;
            for (int i = 0; i < count; ++i) {
                polygon.corners.push_back(points[vertices[i]]);
            }
            polygon.triangles = TriangulatePolygon(polygon.corners);
            _polygons.push_back(polygon);
            vertices += count;
        }
    }

    bool HasFace(uint32_t face) override { return !_polygons[face].triangles.empty(); }

    Sample Evaluate(const FaceParameter& at) override {
        const Polygon& polygon = _polygons[at.face];
        if (at.corner >= polygon.triangles.size()) {
            return {};
        }
        const PolygonTriangle& triangle = polygon.triangles[at.corner];
        const Vec3f& origin = polygon.corners[triangle[0]];
        const Vec3f du = polygon.corners[triangle[1]] - origin;
        const Vec3f dv = polygon.corners[triangle[2]] - origin;
        const Vec3f p = origin + du * at.u + dv * at.v;
        const double position[6] = {p.x, p.y, p.z, p.x, p.y, p.z};
        const double byU[6] = {du.x, du.y, du.z}, byV[6] = {dv.x, dv.y, dv.z};
        Sample sample;
        SetSample(position, byU, byV, &sample);
        return sample;
    }

  private:
    struct Polygon {
        std::vector<Vec3f> corners;
        std::vector<PolygonTriangle> triangles;
    };
    std::vector<Polygon> _polygons;
};

}  // namespace

std::unique_ptr<LimitOracle> MakePolygonOracle(const ControlMesh& mesh,
                                               const std::vector<Vec3f>& points) {
    return std::make_unique<PolygonOracle>(mesh, points);
}

}  // namespace cc::test
