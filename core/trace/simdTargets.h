#pragma once

#include <string>
#include <vector>

namespace cc {

/// The SIMD targets that kernels are compiled for and this processor can run, best first, by
/// Highway's names: AVX3 is AVX-512. The first is in use unless another is asked for.
std::vector<std::string> SimdTargets();

/// The target that kernels run on now.
std::string CurrentSimdTarget();

/// Lets all kernels run on one target from now on: to compare targets, or to keep off one. An empty
/// name means the best. No kernel may run at the same time.
/// Returns an empty string, or one line that says what is allowed.
std::string UseSimdTarget(const std::string& name);

}  // namespace cc
