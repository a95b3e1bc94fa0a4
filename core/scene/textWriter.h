#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "core/math/transform.h"
#include "core/math/vec.h"
#include "core/scene/moving.h"

namespace cc {

/// Writes named values as lines of text for diff: the same values make the same text, and other
/// ones another. Floats have the fewest digits that give them back as they are.
class TextWriter {
  public:
    /// The stream is referred to.
    explicit TextWriter(std::ostream* out) : _out(out) {}

    /// Opens a block, whose lines are indented, until End.
    void Begin(const std::string& heading);
    void End() { --_depth; }

    /// @name A line, or as many as the values ask for; empty arrays have none
    /// @{
    void Write(const std::string& name, const std::string& value);
    void Write(const std::string& name, const char* value) { Write(name, std::string(value)); }
    void Write(const std::string& name, bool value) { Write(name, value ? "true" : "false"); }
    void Write(const std::string& name, int value) { Write(name, std::to_string(value)); }
    void Write(const std::string& name, float value);
    void Write(const std::string& name, const Vec2f& value);
    void Write(const std::string& name, const Vec3f& value);
    /// The three rows of the matrix, one after the other.
    void Write(const std::string& name, const AffineTransform& value);
    void Write(const std::string& name, const std::vector<int>& values);
    /// @param arity  numbers that stand together, above 1 in a line of their own
    void Write(const std::string& name, const std::vector<float>& values, int arity = 1);
    void Write(const std::string& name, const std::vector<Vec3f>& values);
    void Write(const std::string& name, const std::vector<AffineTransform>& values);
    /// At rest as the value itself, else every pose with its time.
    template <class T>
    void Write(const std::string& name, const Moving<T>& values) {
        for (size_t i = 0; i < values.Poses().size(); ++i) {
            Write(values.IsMoving() ? name + " at " + Text(values.Times()[i]) : name,
                  values.Poses()[i]);
        }
    }
    /// @}

    static std::string Text(float number);
    static std::string Text(double number);
    static std::string Text(const Vec3f& value);
    static std::string Text(const AffineTransform& value);

  private:
    void _Line(const std::string& text);
    /// @param text  gives that of value i
    template <class GetText>
    void _WriteArray(const std::string& name, size_t count, size_t valuesALine,
                     const GetText& text);

    std::ostream* _out;
    int _depth = 0;
};

}  // namespace cc
