#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

/// Takes little-endian values off a file; throws std::runtime_error, which names the file, where it
/// cannot be opened, is of another kind, or ends too early.
class BinaryReader {
  public:
    /// @param magic  the eight characters that the file begins with
    BinaryReader(const std::string& path, const char* magic)
        : _path(path), _file(path, std::ios::binary) {
        if (!_file.is_open()) {
            throw std::runtime_error(path + ": cannot be opened");
        }
        if (std::memcmp(Value<std::array<char, 8>>().data(), magic, 8) != 0) {
            throw std::runtime_error(path + ": is of another kind");
        }
    }

    template <class T>
    T Value() {
        T value;
        _Read(&value, sizeof(T));
        return value;
    }

    int Int() { return Value<int32_t>(); }

    /// An array with its length before it.
    template <class T>
    std::vector<T> Array() {
        const uint32_t count = Value<uint32_t>();
        if (count > kLongestArray) {
            throw std::runtime_error(_path + ": an array is too long");
        }
        std::vector<T> values(count);
        _Read(values.data(), count * sizeof(T));
        return values;
    }

    std::string String() {
        const std::vector<char> text = Array<char>();
        return std::string(text.begin(), text.end());
    }

  private:
    static constexpr uint32_t kLongestArray = 1u << 30;

    void _Read(void* to, size_t bytes) {
        if (!_file.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes))) {
            throw std::runtime_error(_path + ": ends too early");
        }
    }

    std::string _path;
    std::ifstream _file;
};
