#pragma once

#include <cstddef>
#include <string>

namespace cc {

/// Memory that this process can still have without swapping, in bytes: what the machine has free or
/// can reclaim, and no more than the control group's limit leaves. SIZE_MAX where neither is known.
/// @param root  in place of /, for tests
size_t AvailableMemory(const std::string& root = "");

}  // namespace cc
