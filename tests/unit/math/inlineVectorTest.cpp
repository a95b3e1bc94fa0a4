#include "core/math/inlineVector.h"

#include <numeric>
#include <utility>

#include <gtest/gtest.h>

namespace cc::test {
namespace {

using Vector = InlineVector<int, 4>;

Vector CountTo(int n) {
    Vector v;
    for (int i = 1; i <= n; ++i) {
        v.push_back(i);
    }
    return v;
}

void ExpectCountTo(const Vector& v, int n) {
    ASSERT_EQ(v.size(), static_cast<size_t>(n));
    for (int i = 0; i < n; ++i) {
        EXPECT_EQ(v[i], i + 1);
    }
}

TEST(InlineVector, KeepsItsValuesWhenItGrows) {
    for (int n : {0, 1, 4, 5, 100}) {
        ExpectCountTo(CountTo(n), n);
    }
}

TEST(InlineVector, CopiesAreApart) {
    for (int n : {3, 9}) {
        Vector a = CountTo(n);
        const Vector b = a;
        a[0] = 77;
        ExpectCountTo(b, n);
    }
}

TEST(InlineVector, MovesAndSwaps) {
    for (int n : {3, 9}) {
        Vector a = CountTo(n), b = CountTo(2);
        a.swap(b);
        ExpectCountTo(a, 2);
        ExpectCountTo(b, n);
        Vector c = std::move(b);
        ExpectCountTo(c, n);
        c = CountTo(1);
        ExpectCountTo(c, 1);
        c.push_back(2);
        ExpectCountTo(c, 2);
    }
}

TEST(InlineVector, Assigns) {
    Vector v = CountTo(9);
    v.assign(6, 5);
    EXPECT_EQ(std::accumulate(v.begin(), v.end(), 0), 30);
    v = {1, 2, 3};
    ExpectCountTo(v, 3);
    EXPECT_EQ(v.back(), 3);
}

}  // namespace
}  // namespace cc::test
