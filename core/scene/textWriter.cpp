#include "core/scene/textWriter.h"

#include <charconv>

namespace cc {
namespace {

constexpr int kIndent = 4;
/// Of single numbers.
constexpr size_t kNumbersALine = 16;

/// Zero is one number to us, whatever its sign.
template <class T>
std::string ShortestText(T number) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof(text), number == 0 ? T(0) : number).ptr;
    return {text, end};
}

}  // namespace

std::string TextWriter::Text(float number) { return ShortestText(number); }

std::string TextWriter::Text(double number) { return ShortestText(number); }

std::string TextWriter::Text(const Vec3f& value) {
    return Text(value.x) + " " + Text(value.y) + " " + Text(value.z);
}

std::string TextWriter::Text(const AffineTransform& value) {
    std::string text;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            const char* const separator = column > 0 ? " " : row > 0 ? "  " : "";
            text += separator + Text(value(row, column));
        }
    }
    return text;
}

void TextWriter::Begin(const std::string& heading) {
    _Line(heading);
    ++_depth;
}

void TextWriter::_Line(const std::string& text) {
    *_out << std::string(static_cast<size_t>(kIndent * _depth), ' ') << text << '\n';
}

void TextWriter::Write(const std::string& name, const std::string& value) {
    _Line(name + " " + value);
}

void TextWriter::Write(const std::string& name, float value) { Write(name, Text(value)); }

void TextWriter::Write(const std::string& name, const Vec2f& value) {
    Write(name, Text(value.x) + " " + Text(value.y));
}

void TextWriter::Write(const std::string& name, const Vec3f& value) { Write(name, Text(value)); }

void TextWriter::Write(const std::string& name, const AffineTransform& value) {
    Write(name, Text(value));
}

template <class GetText>
void TextWriter::_WriteArray(const std::string& name, size_t count, size_t valuesALine,
                             const GetText& text) {
    if (count == 0) {
        return;
    }
    Begin(name + " [" + std::to_string(count) + "]");
    for (size_t first = 0; first < count; first += valuesALine) {
        std::string line = text(first);
        for (size_t i = first + 1; i < count && i < first + valuesALine; ++i) {
            line += " " + text(i);
        }
        _Line(line);
    }
    End();
}

void TextWriter::Write(const std::string& name, const std::vector<int>& values) {
    _WriteArray(name, values.size(), kNumbersALine,
                [&](size_t i) { return std::to_string(values[i]); });
}

void TextWriter::Write(const std::string& name, const std::vector<float>& values, int arity) {
    const auto together = static_cast<size_t>(arity);
    _WriteArray(name, values.size() / together, arity > 1 ? 1 : kNumbersALine, [&](size_t i) {
        std::string text = Text(values[i * together]);
        for (size_t k = 1; k < together; ++k) {
            text += " " + Text(values[i * together + k]);
        }
        return text;
    });
}

void TextWriter::Write(const std::string& name, const std::vector<Vec3f>& values) {
    _WriteArray(name, values.size(), 1, [&](size_t i) { return Text(values[i]); });
}

void TextWriter::Write(const std::string& name, const std::vector<AffineTransform>& values) {
    _WriteArray(name, values.size(), 1, [&](size_t i) { return Text(values[i]); });
}

}  // namespace cc
