#pragma once

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

}  // namespace cc::test
