#include "tests/unit/subdiv/cageKit.h"

#include <algorithm>
#include <cmath>

namespace cc::test {

void AddFace(Cage* cage, const std::vector<int>& vertices) {
    cage->mesh.faceVertexCounts.push_back(static_cast<int>(vertices.size()));
    cage->mesh.faceVertexIndices.insert(cage->mesh.faceVertexIndices.end(), vertices.begin(),
                                        vertices.end());
}

void AddCrease(Cage* cage, const std::vector<int>& vertices, float sharpness) {
    cage->mesh.creaseIndices.insert(cage->mesh.creaseIndices.end(), vertices.begin(),
                                    vertices.end());
    cage->mesh.creaseLengths.push_back(static_cast<int>(vertices.size()));
    cage->mesh.creaseSharpnesses.push_back(sharpness);
}

void AddCorner(Cage* cage, int vertex, float sharpness) {
    cage->mesh.cornerIndices.push_back(vertex);
    cage->mesh.cornerSharpnesses.push_back(sharpness);
}

Cage Named(Cage cage, const std::string& name) {
    cage.name = name;
    return cage;
}

Cage WithScheme(Cage cage, Scheme scheme, const std::string& name) {
    cage.mesh.scheme = scheme;
    return Named(std::move(cage), name);
}

Cage WithBoundary(Cage cage, BoundaryRule rule, const std::string& name) {
    cage.mesh.boundaryRule = rule;
    return Named(std::move(cage), name);
}

Cage WithCrease(Cage cage, const std::vector<int>& vertices, float sharpness,
                const std::string& name) {
    AddCrease(&cage, vertices, sharpness);
    return Named(std::move(cage), name);
}

Cage WithHoles(Cage cage, const std::vector<int>& holes, const std::string& name) {
    cage.mesh.holeIndices = holes;
    return Named(std::move(cage), name);
}

Cage WithCorner(Cage cage, int vertex, float sharpness, const std::string& name) {
    AddCorner(&cage, vertex, sharpness);
    return Named(std::move(cage), name);
}

Cage Rough(Cage cage) {
    for (size_t i = 0; i < cage.points.size(); ++i) {
        const float x = static_cast<float>(i);
        cage.points[i] +=
            Vec3f{std::sin(12.9f * x), std::sin(78.2f * x + 1), std::sin(37.7f * x + 2)} * 0.4f;
    }
    cage.name = "rough " + cage.name;
    return cage;
}

Cage Triangulated(const Cage& cage) {
    Cage result = cage;
    result.mesh.scheme = Scheme::Loop;
    result.mesh.faceVertexCounts.clear();
    result.mesh.faceVertexIndices.clear();
    result.mesh.holeIndices.clear();
    const std::vector<int>& holes = cage.mesh.holeIndices;
    const int* vertices = cage.mesh.faceVertexIndices.data();
    for (int face = 0; face < cage.mesh.FaceCount(); ++face) {
        const bool isHole = std::find(holes.begin(), holes.end(), face) != holes.end();
        const int count = cage.mesh.faceVertexCounts[face];
        for (int i = 2; i < count; ++i) {
            if (isHole) {
                result.mesh.holeIndices.push_back(result.mesh.FaceCount());
            }
            AddFace(&result, {vertices[0], vertices[i - 1], vertices[i]});
        }
        vertices += count;
    }
    return result;
}

Cage Roof() {
    Cage cage = Named(Sheet(4), "roof");
    for (Vec3f& point : cage.points) {
        point.z = 0.3f * point.z - 0.9f * (std::abs(point.x - 2) + std::abs(point.y - 2));
    }
    return cage;
}

Cage FromFaces(const std::string& name, const std::vector<std::vector<int>>& faces) {
    Cage cage = FromFaces(name, faces, {});
    int last = 0;
    for (const std::vector<int>& face : faces) {
        last = std::max(last, *std::max_element(face.begin(), face.end()));
    }
    for (int i = 0; i <= last; ++i) {
        const float angle = 2.399963f * static_cast<float>(i);
        const float radius = 0.5f + 0.3f * static_cast<float>(i);
        cage.points.push_back({radius * std::cos(angle), radius * std::sin(angle),
                               std::sin(1.9f * static_cast<float>(i))});
    }
    return cage;
}

Cage FromFaces(const std::string& name, const std::vector<std::vector<int>>& faces,
               const std::vector<Vec3f>& points) {
    Cage cage;
    cage.name = name;
    cage.points = points;
    for (const std::vector<int>& face : faces) {
        AddFace(&cage, face);
    }
    return cage;
}

}  // namespace cc::test
