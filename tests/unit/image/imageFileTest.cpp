#include "core/image/imageFile.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

namespace cc {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 5, kHeight = 150;  // more than one band of rows

/// A folder that goes with the test.
class ImageFile : public testing::Test {
  protected:
    ImageFile() {
        std::string pattern = (fs::temp_directory_path() / "imageFileTest-XXXXXX").string();
        _folder = mkdtemp(pattern.data());
    }
    ~ImageFile() override { fs::remove_all(_folder); }

    std::string _Path(const std::string& name) const { return (_folder / name).string(); }
    size_t _FileCount() const {
        return std::distance(fs::directory_iterator(_folder), fs::directory_iterator());
    }

    fs::path _folder;
};

struct Picture {
    OIIO::ImageSpec spec;
    std::vector<float> pixels;

    float At(int x, int rowFromBottom, const std::string& channel) const {
        const size_t pixel = static_cast<size_t>(spec.height - 1 - rowFromBottom) * spec.width + x;
        return pixels[pixel * spec.nchannels + spec.channelindex(channel)];
    }
};

Picture Read(const std::string& path) {
    Picture picture;
    const auto input = OIIO::ImageInput::open(path);
    EXPECT_TRUE(input) << OIIO::geterror();
    if (input) {
        picture.spec = input->spec();
        picture.pixels.resize(picture.spec.image_pixels() * picture.spec.nchannels);
        input->read_image(0, 0, 0, picture.spec.nchannels, OIIO::TypeFloat, picture.pixels.data());
    }
    return picture;
}

/// Values that tell pixel and component apart.
std::vector<float> Floats(int components) {
    std::vector<float> values(kWidth * kHeight * components);
    for (size_t i = 0; i < values.size(); ++i) {
        values[i] = static_cast<float>(i) / values.size();
    }
    return values;
}

ImagePlane Plane(const std::string& name, int components, const std::vector<float>& values) {
    return {name, components, false, values.data()};
}

TEST_F(ImageFile, ExrHoldsAllPlanesUnderTheirNames) {
    const std::vector<float> color = Floats(4), depth = Floats(1), normal = Floats(3);
    std::vector<int32_t> ids(kWidth * kHeight, -1);
    ids[2 * kWidth + 1] = 16777215;
    const std::string path = _Path("all.exr");
    ASSERT_EQ(WriteImage(path, kWidth, kHeight,
                         {Plane("color", 4, color),
                          Plane("depth", 1, depth),
                          Plane("normal", 3, normal),
                          {"primId", 1, true, ids.data()}}),
              "");
    const Picture picture = Read(path);
    std::map<std::string, OIIO::TypeDesc> formats;
    for (int c = 0; c < picture.spec.nchannels; ++c) {
        formats[picture.spec.channelnames[c]] = picture.spec.channelformat(c);
    }
    const std::map<std::string, OIIO::TypeDesc> expected = {
        {"R", OIIO::TypeHalf},        {"G", OIIO::TypeHalf},        {"B", OIIO::TypeHalf},
        {"A", OIIO::TypeHalf},        {"depth.Z", OIIO::TypeFloat}, {"normal.X", OIIO::TypeHalf},
        {"normal.Y", OIIO::TypeHalf}, {"normal.Z", OIIO::TypeHalf}, {"primId.X", OIIO::TypeFloat},
    };
    EXPECT_EQ(formats, expected);
    for (const int row : {0, 2, 70, kHeight - 1}) {
        for (int x = 0; x < kWidth; ++x) {
            const size_t i = row * kWidth + x;
            EXPECT_NEAR(picture.At(x, row, "G"), color[4 * i + 1], 5e-4f);
            EXPECT_NEAR(picture.At(x, row, "A"), color[4 * i + 3], 5e-4f);
            EXPECT_NEAR(picture.At(x, row, "normal.Z"), normal[3 * i + 2], 5e-4f);
            EXPECT_EQ(picture.At(x, row, "depth.Z"), depth[i]);
            EXPECT_EQ(picture.At(x, row, "primId.X"), static_cast<float>(ids[i]));
        }
    }
    EXPECT_EQ(picture.spec.get_string_attribute("compression"), "zip");
    EXPECT_EQ(picture.spec.get_string_attribute("Software"), "hdCC");
    EXPECT_EQ(_FileCount(), 1u);
}

TEST_F(ImageFile, LayersAndTypesCanBeChosen) {
    const std::vector<float> color = Floats(4), depth = Floats(1);
    ImagePlane beauty = Plane("beauty", 4, color), precise = beauty, z = Plane("Z", 1, depth);
    beauty.isColor = precise.isColor = true;
    precise.name = "precise";
    precise.isHalf = false;
    z.isHalf = true;
    const std::string path = _Path("layers.exr");
    ASSERT_EQ(WriteImage(path, kWidth, kHeight, {beauty, precise, z}), "");
    const Picture picture = Read(path);
    std::map<std::string, OIIO::TypeDesc> formats;
    for (int c = 0; c < picture.spec.nchannels; ++c) {
        formats[picture.spec.channelnames[c]] = picture.spec.channelformat(c);
    }
    const std::map<std::string, OIIO::TypeDesc> expected = {
        {"beauty.R", OIIO::TypeHalf},   {"beauty.G", OIIO::TypeHalf},
        {"beauty.B", OIIO::TypeHalf},   {"beauty.A", OIIO::TypeHalf},
        {"precise.R", OIIO::TypeFloat}, {"precise.G", OIIO::TypeFloat},
        {"precise.B", OIIO::TypeFloat}, {"precise.A", OIIO::TypeFloat},
        {"Z.Z", OIIO::TypeHalf}};
    EXPECT_EQ(formats, expected);
    EXPECT_EQ(picture.At(2, 3, "precise.G"), color[4 * (3 * kWidth + 2) + 1]);
}

TEST_F(ImageFile, TheHeaderSaysWhatItIsGiven) {
    const std::vector<float> color = Floats(4);
    ImageHeader header;
    header.x = -3;
    header.y = 5;
    header.fullWidth = 200;
    header.fullHeight = 300;
    header.pixelAspect = 2;
    header.texts = {{"shot", "a 12"}};
    header.numbers = {{"frame", 7.5}};
    std::array<float, 16> matrix{};
    for (size_t i = 0; i < matrix.size(); ++i) {
        matrix[i] = static_cast<float>(i);
    }
    header.matrices = {{"worldtocamera", matrix}};
    const std::string path = _Path("header.exr");
    ASSERT_EQ(WriteImage(path, kWidth, kHeight, {Plane("color", 4, color)}, header), "");
    const Picture picture = Read(path);
    EXPECT_EQ(picture.spec.x, -3);
    EXPECT_EQ(picture.spec.y, 5);
    EXPECT_EQ(picture.spec.width, kWidth);
    EXPECT_EQ(picture.spec.full_x, 0);
    EXPECT_EQ(picture.spec.full_width, 200);
    EXPECT_EQ(picture.spec.full_height, 300);
    EXPECT_EQ(picture.spec.get_float_attribute("PixelAspectRatio"), 2);
    EXPECT_EQ(picture.spec.get_string_attribute("shot"), "a 12");
    EXPECT_EQ(picture.spec.get_float_attribute("frame"), 7.5f);
    const OIIO::ParamValue* const found = picture.spec.find_attribute("worldtocamera");
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->get<float>(13), 13);
    EXPECT_NEAR(picture.At(1, 2, "G"), color[4 * (2 * kWidth + 1) + 1], 5e-4f);
}

TEST_F(ImageFile, HalfDoesNotOverflow) {
    std::vector<float> color = Floats(4);
    color[0] = 1e6f;
    color[1] = -1e6f;
    const std::string path = _Path("bright.exr");
    ASSERT_EQ(WriteImage(path, kWidth, kHeight, {Plane("color", 4, color)}), "");
    EXPECT_EQ(Read(path).At(0, 0, "R"), 65504);
    EXPECT_EQ(Read(path).At(0, 0, "G"), -65504);
}

TEST_F(ImageFile, TheSamePictureIsTheSameFileAtAnyTime) {
    const std::vector<float> color = Floats(4);
    const auto bytes = [&](const std::string& name) {
        EXPECT_EQ(WriteImage(_Path(name), kWidth, kHeight, {Plane("color", 4, color)}), "");
        std::ifstream file(_Path(name), std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    const std::string first = bytes("first.exr");
    EXPECT_FALSE(first.empty());
    EXPECT_EQ(first, bytes("second.exr"));
    for (const char* name : {"first.exr", "a.png", "a.tif"}) {
        bytes(name);
        EXPECT_EQ(Read(_Path(name)).spec.get_string_attribute("DateTime"), "") << name;
    }
}

TEST_F(ImageFile, DisplayFormatsTakeTheColor) {
    const std::vector<float> color = Floats(4), depth = Floats(1);
    for (const char* name : {"a.png", "a.tif", "a.TIFF", "a.jpg"}) {
        ASSERT_EQ(WriteImage(_Path(name), kWidth, kHeight,
                             {Plane("depth", 1, depth), Plane("color", 4, color)}),
                  "")
            << name;
        const Picture picture = Read(_Path(name));
        ASSERT_EQ(picture.spec.width, kWidth);
        ASSERT_EQ(picture.spec.height, kHeight);
        EXPECT_EQ(picture.spec.format, OIIO::TypeUInt8);
        EXPECT_EQ(picture.spec.nchannels, std::string(name) == "a.jpg" ? 3 : 4);
        for (const int row : {0, 75, kHeight - 1}) {
            // Readers multiply by alpha what the file has divided: what was rendered comes back.
            EXPECT_NEAR(picture.At(2, row, "R"), color[4 * (row * kWidth + 2)], 0.03f) << name;
        }
    }
}

TEST_F(ImageFile, DisplayFormatsSurviveAnyValue) {
    std::vector<float> color = Floats(4);
    color[0] = NAN;
    color[1] = INFINITY;
    color[2] = -5;
    color[3] = 1;
    ASSERT_EQ(WriteImage(_Path("odd.png"), kWidth, kHeight, {Plane("color", 4, color)}), "");
    const Picture picture = Read(_Path("odd.png"));
    EXPECT_EQ(picture.At(0, 0, "R"), 0);
    EXPECT_EQ(picture.At(0, 0, "G"), 1);
    EXPECT_EQ(picture.At(0, 0, "B"), 0);
}

TEST_F(ImageFile, SaysWhatIsWrongInOneLineAndLeavesNothing) {
    const std::vector<float> color = Floats(4);
    const std::vector<ImagePlane> good = {Plane("color", 4, color)};
    const auto fails = [&](const std::string& path, int width, const std::vector<ImagePlane>& p) {
        const std::string error = WriteImage(path, width, kHeight, p);
        EXPECT_NE(error.find(path), std::string::npos) << error;
        EXPECT_GT(error.size(), path.size() + 20) << "no reason: " << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    };
    fails(_Path("no/such/folder.exr"), kWidth, good);
    fails(_Path("no/such/folder.png"), kWidth, good);
    fails(_Path("unknown.xyz"), kWidth, good);
    fails(_Path("noExtension"), kWidth, good);
    fails(_Path("empty.exr"), 0, good);
    fails(_Path("nothing.exr"), kWidth, {});
    fails(_Path("null.exr"), kWidth, {{"color", 4, false, nullptr}});
    fails(_Path("twice.exr"), kWidth, {good[0], good[0]});
    fails(_Path("noColor.png"), kWidth, {Plane("depth", 1, color)});
    EXPECT_EQ(_FileCount(), 0u);

    fs::create_directories(_folder / "folder.exr" / "full");
    fails(_Path("folder.exr"), kWidth, good);
    EXPECT_EQ(_FileCount(), 1u);
}

TEST_F(ImageFile, AFailureKeepsTheOldPicture) {
    const std::vector<float> color = Floats(4);
    const std::string path = _Path("kept.exr");
    ASSERT_EQ(WriteImage(path, kWidth, kHeight, {Plane("color", 4, color)}), "");
    ASSERT_NE(WriteImage(path, kWidth, kHeight, {}), "");
    EXPECT_EQ(Read(path).spec.width, kWidth);
}

TEST(IsDisplayFormat, GoesByTheExtension) {
    EXPECT_TRUE(IsDisplayFormat("a/b.png"));
    EXPECT_TRUE(IsDisplayFormat("b.JPEG"));
    EXPECT_TRUE(IsDisplayFormat("b.0001.tif"));
    EXPECT_FALSE(IsDisplayFormat("b.exr"));
    EXPECT_FALSE(IsDisplayFormat("png"));
    EXPECT_FALSE(IsDisplayFormat("folder.png/b"));
}

}  // namespace
}  // namespace cc
