#pragma once

#include <cstddef>
#include <vector>

namespace cc::test {

/// How often to repeat what only finds more of the same. Sanitizers make programs ten times as
/// slow, and what they look for shows in the first few.
constexpr int Repeats(int count) {
#ifdef CC_SANITIZED
    return (count + 7) / 8;
#else
    return count;
#endif
}

/// All of many that are alike, or where tests are to be short a fifth of them.
template <class T>
std::vector<T> Sample(const std::vector<T>& all) {
#ifdef CC_SANITIZED
    std::vector<T> some;
    for (size_t i = 0; i < all.size(); i += 5) {
        some.push_back(all[i]);
    }
    return some;
#else
    return all;
#endif
}

}  // namespace cc::test
