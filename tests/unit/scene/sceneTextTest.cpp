#include "core/scene/sceneText.h"

#include <limits>
#include <sstream>

#include <gtest/gtest.h>

namespace cc {
namespace {

template <class T>
std::string TextOf(const std::string& name, const T& value) {
    std::ostringstream text;
    TextWriter(&text).Write(name, value);
    return text.str();
}

std::string TextOf(Scene* scene) {
    scene->Build({});
    std::ostringstream text;
    TextWriter out(&text);
    WriteText(*scene, &out);
    return text.str();
}

TEST(TextWriter, FloatsAreShortAndExact) {
    EXPECT_EQ(TextOf("x", 0.1f), "x 0.1\n");
    EXPECT_EQ(TextOf("x", -0.0f), "x 0\n");
    EXPECT_EQ(TextOf("x", std::numeric_limits<float>::infinity()), "x inf\n");
    const float third = 1.0f / 3;
    EXPECT_EQ(std::stof(TextWriter::Text(third)), third);
    EXPECT_NE(TextWriter::Text(third), TextWriter::Text(std::nextafter(third, 1.0f)));
}

TEST(TextWriter, ArraysHaveTheirSizeAndLinesOfTheirOwn) {
    EXPECT_EQ(TextOf("none", std::vector<int>()), "");
    EXPECT_EQ(TextOf("some", std::vector<int>{3, 1}), "some [2]\n    3 1\n");
    EXPECT_EQ(TextOf("p", std::vector<Vec3f>{{1, 2, 3}, {4, 5, 6}}),
              "p [2]\n    1 2 3\n    4 5 6\n");
    EXPECT_EQ(TextOf("many", std::vector<int>(17, 7)),
              "many [17]\n    7 7 7 7 7 7 7 7 7 7 7 7 7 7 7 7\n    7\n");
}

TEST(TextWriter, MovingValuesHaveTimes) {
    EXPECT_EQ(TextOf("x", Moving<float>(2.0f)), "x 2\n");
    EXPECT_EQ(TextOf("x", Moving<float>({-0.5f, 0.5f}, {2, 3})), "x at -0.5 2\nx at 0.5 3\n");
}

ControlMesh MakeQuad() {
    ControlMesh quad;
    quad.faceVertexCounts = {4};
    quad.faceVertexIndices = {0, 1, 2, 3};
    return quad;
}

const std::vector<Vec3f> kCorners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

void AddQuad(Scene* scene, const std::string& name) {
    Mesh* const mesh = scene->AddMesh(name);
    mesh->SetTopology(MakeQuad());
    mesh->SetPoints(kCorners);
}

TEST(SceneText, OrderOfPrimsDoesNotMatter) {
    Scene a, b;
    for (const char* name : {"/A", "/B"}) {
        AddQuad(&a, name);
    }
    for (const char* name : {"/B", "/A"}) {
        AddQuad(&b, name);
    }
    EXPECT_EQ(TextOf(&a), TextOf(&b));
    EXPECT_NE(TextOf(&a).find("mesh </A>"), std::string::npos);
}

TEST(SceneText, HowItCameAboutDoesNotMatter) {
    Scene fresh;
    AddQuad(&fresh, "/Quad");
    Scene edited;
    Mesh* const mesh = edited.AddMesh("/Quad");
    ControlMesh other = MakeQuad();
    other.cornerIndices = {0};
    other.cornerSharpnesses = {3};
    mesh->SetTopology(other);
    mesh->SetPoints(std::vector<Vec3f>(5, Vec3f{1, 2, 3}));
    mesh->SetPrimvar("st", {Interpolation::Vertex, 2, std::vector<float>(10), {}});
    mesh->SetInstances({AffineTransform()});
    EXPECT_NE(TextOf(&edited), TextOf(&fresh));

    mesh->SetTopology(MakeQuad());
    mesh->SetPoints(kCorners);
    mesh->SetPrimvar("st", {});
    mesh->ClearInstances();
    EXPECT_EQ(TextOf(&edited), TextOf(&fresh));
}

TEST(SceneText, WhatIsNotShownIsNamed) {
    Scene scene;
    AddQuad(&scene, "/Quad");
    Mesh* const broken = scene.AddMesh("/Broken");
    broken->SetTopology(MakeQuad());
    broken->SetPoints({{0, 0, 0}});
    const std::string shown = TextOf(&scene);
    EXPECT_EQ(shown.substr(0, 58), "mesh </Broken>\n    renderTag geometry\n    shown false\nmesh");
    scene.Shapes()[1]->SetVisible(false);
    EXPECT_EQ(TextOf(&scene),
              shown.substr(0, 54) + "mesh </Quad>\n    renderTag geometry\n    shown false\n");
}

TEST(SceneText, MovingPointsAreThoseOfAllPoses) {
    Scene scene;
    AddQuad(&scene, "/Quad");
    std::vector<Vec3f> lifted = kCorners;
    lifted[2].z = 5;
    static_cast<Mesh*>(scene.Shapes()[0].get())->SetMovingPoints({{0, 1}, {kCorners, lifted}});
    const std::string text = TextOf(&scene);
    EXPECT_NE(text.find("points at 0 [4]\n        0 0 0\n"), std::string::npos) << text;
    EXPECT_NE(text.find("points at 1 [4]\n        0 0 0\n        1 0 0\n        1 1 5\n"),
              std::string::npos)
        << text;
}

TEST(SceneText, VertexPrimvarsAreThoseOfTheCage) {
    Scene scene;
    AddQuad(&scene, "/Quad");
    scene.Shapes()[0]->SetPrimvar("st", {Interpolation::Vertex, 2, {1, 2, 3, 4, 5, 6, 7, 8}, {}});
    const std::string text = TextOf(&scene);
    EXPECT_NE(text.find("    primvars:st vertex\n        values [4]\n            1 2\n"),
              std::string::npos)
        << text;
}

TEST(SceneText, LightsAndCamerasAreWritten) {
    Scene scene;
    Light* const light = scene.AddLight();
    light->kind = Light::Kind::Sphere;
    light->position = {1, 2, 3};
    EXPECT_EQ(TextOf(&scene),
              "light sphere\n    position 1 2 3\n    power 1 1 1\n    castsShadows true\n");
    Camera camera;
    camera.clipPlanes.push_back({{0, 0, 1}, 2});
    std::ostringstream text;
    TextWriter out(&text);
    WriteText(camera, &out);
    EXPECT_NE(text.str().find("    clippingPlane 0 0 1 2\n"), std::string::npos) << text.str();
}

}  // namespace
}  // namespace cc
