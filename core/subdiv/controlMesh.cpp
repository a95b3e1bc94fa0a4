#include "core/subdiv/controlMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_set>

namespace cc {
namespace {

std::string Text(const char* what, size_t count) { return what + std::to_string(count); }

/// Loop subdivision is defined on triangles. OpenSubdiv refuses other faces too; faces of fewer
/// vertices are left out under every scheme.
std::string CheckTriangles(const ControlMesh& mesh) {
    const auto isLarger = [](int count) { return count > 3; };
    const auto& counts = mesh.faceVertexCounts;
    const auto larger = std::count_if(counts.begin(), counts.end(), isLarger);
    if (larger == 0) {
        return {};
    }
    const auto first = std::find_if(counts.begin(), counts.end(), isLarger) - counts.begin();
    return std::to_string(larger) + " of " + std::to_string(counts.size()) +
           " faces are no triangles, which the loop scheme asks for (the first is face " +
           std::to_string(first) + ")";
}

std::string CheckFaces(const ControlMesh& mesh, size_t pointCount) {
    int64_t total = 0;
    for (size_t face = 0; face < mesh.faceVertexCounts.size(); ++face) {
        if (mesh.faceVertexCounts[face] < 0) {
            return Text("faceVertexCounts is negative at face ", face);
        }
        total += mesh.faceVertexCounts[face];
    }
    if (total != static_cast<int64_t>(mesh.faceVertexIndices.size())) {
        return "faceVertexCounts add up to " + std::to_string(total) + ", but there are " +
               std::to_string(mesh.faceVertexIndices.size()) + " faceVertexIndices";
    }
    for (size_t i = 0; i < mesh.faceVertexIndices.size(); ++i) {
        const int vertex = mesh.faceVertexIndices[i];
        if (vertex < 0 || static_cast<size_t>(vertex) >= pointCount) {
            return "faceVertexIndices[" + std::to_string(i) + "] is " + std::to_string(vertex) +
                   ", outside the mesh's " + std::to_string(pointCount) + " points";
        }
    }
    return mesh.scheme == Scheme::Loop ? CheckTriangles(mesh) : std::string();
}

/// Polygons that are not subdivided are triangulated whatever vertices they have.
void WarnOfSmallFaces(const ControlMesh& mesh, ControlMeshReport* report) {
    const auto small = std::count_if(mesh.faceVertexCounts.begin(), mesh.faceVertexCounts.end(),
                                     [](int count) { return count < 3; });
    if (small > 0) {
        report->warnings.push_back(std::to_string(small) +
                                   " faces have fewer than three vertices and are left out");
    }
}

/// Why a smooth surface would take too long to build; empty if it does not.
std::string CheckValences(const ControlMesh& mesh, size_t pointCount) {
    if (mesh.scheme != Scheme::CatmullClark && mesh.scheme != Scheme::Loop) {
        return {};
    }
    const int limit = mesh.scheme == Scheme::Loop ? kMaxLoopValence : kMaxValence;
    const std::string limitText = "; the limit is " + std::to_string(limit);
    const std::vector<int>& sizes = mesh.faceVertexCounts;
    const auto largest = std::max_element(sizes.begin(), sizes.end());
    if (largest != sizes.end() && *largest > limit) {
        return "face " + std::to_string(largest - sizes.begin()) + " has " +
               std::to_string(*largest) + " vertices" + limitText;
    }
    std::vector<int> faceCounts(pointCount, 0);
    for (int vertex : mesh.faceVertexIndices) {
        ++faceCounts[vertex];
    }
    const auto most = std::max_element(faceCounts.begin(), faceCounts.end());
    if (most != faceCounts.end() && *most > limit) {
        return "vertex " + std::to_string(most - faceCounts.begin()) + " has " +
               std::to_string(*most) + " faces" + limitText;
    }
    return {};
}

void WarnOfDegenerateFaces(const ControlMesh& mesh, ControlMeshReport* report) {
    if (mesh.scheme == Scheme::None) {
        WarnOfSmallFaces(mesh, report);
        return;
    }
    size_t collapsed = 0, leftOut = 0;
    const int* face = mesh.faceVertexIndices.data();
    for (int count : mesh.faceVertexCounts) {
        if (!KeepsAllCorners(face, count)) {
            const bool isKept = !KeptCorners(face, count).empty();
            leftOut += !isKept;
            collapsed += isKept;
        }
        face += count;
    }
    if (leftOut > 0) {
        report->warnings.push_back(std::to_string(leftOut) +
                                   " faces have fewer than three vertices, or one of them twice, "
                                   "and are left out");
    }
    if (collapsed > 0) {
        report->warnings.push_back(std::to_string(collapsed) +
                                   " faces have collapsed edges, which are taken out");
    }
}

void MendHoles(ControlMesh* mesh, ControlMeshReport* report) {
    std::vector<int>& holes = mesh->holeIndices;
    const size_t before = holes.size();
    holes.erase(std::remove_if(holes.begin(), holes.end(),
                               [mesh](int face) { return face < 0 || face >= mesh->FaceCount(); }),
                holes.end());
    if (holes.size() < before) {
        report->warnings.push_back(std::to_string(before - holes.size()) +
                                   " holeIndices name no face and are ignored");
    }
    std::sort(holes.begin(), holes.end());
    holes.erase(std::unique(holes.begin(), holes.end()), holes.end());
}

/// Clamps a sharpness into [0, 10]; NaN becomes 0. Returns false if it had to.
bool MendSharpness(float* sharpness) {
    // USD leaves values above 10 to mean infinitely sharp: no reason to warn.
    const bool isGood = *sharpness >= 0;
    *sharpness = isGood ? std::min(*sharpness, 10.0f) : 0.0f;
    return isGood;
}

uint64_t EdgeKey(int a, int b) {
    return static_cast<uint64_t>(std::min(a, b)) << 32 | static_cast<uint32_t>(std::max(a, b));
}

std::unordered_set<uint64_t> EdgesOf(const ControlMesh& mesh) {
    std::unordered_set<uint64_t> edges;
    const int* face = mesh.faceVertexIndices.data();
    for (int count : mesh.faceVertexCounts) {
        for (int i = 0; i < count; ++i) {
            edges.insert(EdgeKey(face[i], face[(i + 1) % count]));
        }
        face += count;
    }
    return edges;
}

/// Why the crease arrays contradict each other; empty if they do not.
std::string CheckCreaseArrays(const ControlMesh& mesh) {
    int64_t vertices = 0, edges = 0;
    for (int length : mesh.creaseLengths) {
        if (length < 2) {
            return "creaseLengths has " + std::to_string(length) + ", below 2";
        }
        vertices += length;
        edges += length - 1;
    }
    if (vertices != static_cast<int64_t>(mesh.creaseIndices.size())) {
        return "creaseLengths add up to " + std::to_string(vertices) + ", but there are " +
               std::to_string(mesh.creaseIndices.size()) + " creaseIndices";
    }
    const auto count = static_cast<int64_t>(mesh.creaseSharpnesses.size());
    if (count != static_cast<int64_t>(mesh.creaseLengths.size()) && count != edges) {
        return std::to_string(count) + " creaseSharpnesses are neither one a crease (" +
               std::to_string(mesh.creaseLengths.size()) + ") nor one an edge (" +
               std::to_string(edges) + ")";
    }
    return {};
}

/// Rewrites creases as runs of two vertices with a sharpness each, keeping those that are edges.
void MendCreases(ControlMesh* mesh, ControlMeshReport* report) {
    const std::string contradiction = CheckCreaseArrays(*mesh);
    std::vector<int> indices;
    std::vector<float> sharpnesses;
    size_t strays = 0, mended = 0;
    if (!contradiction.empty()) {
        report->warnings.push_back(contradiction + "; creases are ignored");
    } else if (!mesh->creaseLengths.empty()) {
        const std::unordered_set<uint64_t> edges = EdgesOf(*mesh);
        const bool oneACrease = mesh->creaseSharpnesses.size() == mesh->creaseLengths.size();
        size_t vertex = 0, edge = 0;
        for (size_t crease = 0; crease < mesh->creaseLengths.size(); ++crease) {
            for (int i = 1; i < mesh->creaseLengths[crease]; ++i, ++edge) {
                const int a = mesh->creaseIndices[vertex + i - 1];
                const int b = mesh->creaseIndices[vertex + i];
                float sharpness = mesh->creaseSharpnesses[oneACrease ? crease : edge];
                mended += !MendSharpness(&sharpness);
                if (a == b || edges.count(EdgeKey(a, b)) == 0) {
                    ++strays;
                } else if (sharpness > 0) {
                    indices.insert(indices.end(), {a, b});
                    sharpnesses.push_back(sharpness);
                }
            }
            vertex += mesh->creaseLengths[crease];
        }
    }
    if (strays > 0) {
        report->warnings.push_back(std::to_string(strays) +
                                   " crease edges are no edges of the mesh and are ignored");
    }
    if (mended > 0) {
        report->warnings.push_back(std::to_string(mended) +
                                   " creaseSharpnesses are negative or NaN and count as 0");
    }
    mesh->creaseIndices = std::move(indices);
    mesh->creaseLengths.assign(sharpnesses.size(), 2);
    mesh->creaseSharpnesses = std::move(sharpnesses);
}

void MendCorners(ControlMesh* mesh, size_t pointCount, ControlMeshReport* report) {
    if (mesh->cornerIndices.size() != mesh->cornerSharpnesses.size()) {
        report->warnings.push_back(
            std::to_string(mesh->cornerSharpnesses.size()) + " cornerSharpnesses for " +
            std::to_string(mesh->cornerIndices.size()) + " cornerIndices; corners are ignored");
        mesh->cornerIndices.clear();
        mesh->cornerSharpnesses.clear();
        return;
    }
    std::vector<int> indices;
    std::vector<float> sharpnesses;
    size_t strays = 0, mended = 0;
    for (size_t i = 0; i < mesh->cornerIndices.size(); ++i) {
        const int vertex = mesh->cornerIndices[i];
        float sharpness = mesh->cornerSharpnesses[i];
        mended += !MendSharpness(&sharpness);
        if (vertex < 0 || static_cast<size_t>(vertex) >= pointCount) {
            ++strays;
        } else if (sharpness > 0) {
            indices.push_back(vertex);
            sharpnesses.push_back(sharpness);
        }
    }
    if (strays > 0) {
        report->warnings.push_back(std::to_string(strays) +
                                   " cornerIndices name no point and are ignored");
    }
    if (mended > 0) {
        report->warnings.push_back(std::to_string(mended) +
                                   " cornerSharpnesses are negative or NaN and count as 0");
    }
    mesh->cornerIndices = std::move(indices);
    mesh->cornerSharpnesses = std::move(sharpnesses);
}

}  // namespace

std::vector<int> KeptCorners(const int* vertices, int count) {
    std::vector<int> kept;
    for (int i = 0; i < count; ++i) {
        if (vertices[i] != vertices[(i + count - 1) % count]) {
            kept.push_back(i);
        }
    }
    std::vector<int> sorted;
    for (int corner : kept) {
        sorted.push_back(vertices[corner]);
    }
    std::sort(sorted.begin(), sorted.end());
    const bool meetsTwice = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
    return kept.size() < 3 || meetsTwice ? std::vector<int>() : kept;
}

bool KeepsAllCorners(const int* vertices, int count) {
    constexpr int kFew = 8;
    if (count > kFew) {
        return KeptCorners(vertices, count).size() == static_cast<size_t>(count);
    }
    for (int i = 1; i < count; ++i) {
        for (int j = 0; j < i; ++j) {
            if (vertices[i] == vertices[j]) {
                return false;
            }
        }
    }
    return count >= 3;
}

ControlMeshReport ValidateControlMesh(ControlMesh* mesh, size_t pointCount) {
    ControlMeshReport report;
    report.error = CheckFaces(*mesh, pointCount);
    if (report.IsValid()) {
        report.error = CheckValences(*mesh, pointCount);
    }
    if (report.IsValid()) {
        WarnOfDegenerateFaces(*mesh, &report);
        MendHoles(mesh, &report);
        MendCreases(mesh, &report);
        MendCorners(mesh, pointCount, &report);
    }
    return report;
}

}  // namespace cc
