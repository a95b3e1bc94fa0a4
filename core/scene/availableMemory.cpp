#include "core/scene/availableMemory.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <optional>

namespace cc {
namespace {

/// The number behind a key, in a file of lines of both.
std::optional<size_t> NumberOf(const std::string& path, const std::string& key) {
    std::ifstream file(path);
    std::string word;
    while (file >> word) {
        size_t number = 0;
        if (word == key && file >> number) {
            return number;
        }
    }
    return std::nullopt;
}

/// The number that a file begins with; none if it says "max".
std::optional<size_t> NumberIn(const std::string& path) {
    std::ifstream file(path);
    size_t number = 0;
    return file >> number ? std::optional<size_t>(number) : std::nullopt;
}

}  // namespace

size_t AvailableMemory(const std::string& root) {
    size_t available = SIZE_MAX;
    if (const auto kilobytes = NumberOf(root + "/proc/meminfo", "MemAvailable:")) {
        available = *kilobytes * 1024;
    }
    const std::string group = root + "/sys/fs/cgroup/memory.";
    const auto limit = NumberIn(group + "max"), used = NumberIn(group + "current");
    if (limit && used) {
        // Files that were read count as used, until somebody else needs the memory.
        const size_t files = NumberOf(group + "stat", "inactive_file").value_or(0);
        const size_t held = *used - std::min(*used, files);
        available = std::min(available, *limit - std::min(*limit, held));
    }
    return available;
}

}  // namespace cc
