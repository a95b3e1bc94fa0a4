#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <type_traits>

namespace cc {

/// A vector of plain values that holds up to N of them without an allocation: for rings of points,
/// which are short but for a few. Not for types with constructors of consequence.
template <typename T, size_t N>
class InlineVector {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    InlineVector() = default;
    InlineVector(std::initializer_list<T> values) { *this = values; }
    InlineVector(const InlineVector& other) { *this = other; }
    InlineVector(InlineVector&& other) noexcept { *this = std::move(other); }

    InlineVector& operator=(const InlineVector& other) {
        if (this != &other) {
            assign(other.begin(), other.end());
        }
        return *this;
    }
    InlineVector& operator=(InlineVector&& other) noexcept {
        if (this == &other) {
            return *this;
        }
        if (other._heap) {
            _heap = std::move(other._heap);
            _capacity = other._capacity;
            _size = other._size;
            other._size = 0;
            other._capacity = N;
        } else {
            assign(other.begin(), other.end());
        }
        return *this;
    }
    InlineVector& operator=(std::initializer_list<T> values) {
        assign(values.begin(), values.end());
        return *this;
    }

    size_t size() const { return _size; }
    T* begin() { return _heap ? _heap.get() : _values; }
    T* end() { return begin() + _size; }
    const T* begin() const { return _heap ? _heap.get() : _values; }
    const T* end() const { return begin() + _size; }
    const T* data() const { return begin(); }
    T& operator[](size_t i) { return begin()[i]; }
    const T& operator[](size_t i) const { return begin()[i]; }
    const T& front() const { return *begin(); }
    const T& back() const { return *(end() - 1); }

    void push_back(T value) {
        if (_size == _capacity) {
            _Grow(2 * _capacity);
        }
        begin()[_size++] = value;
    }
    void assign(const T* first, const T* last) {
        resize(static_cast<size_t>(last - first));
        std::copy(first, last, begin());
    }
    void assign(size_t count, T value) {
        resize(count);
        std::fill(begin(), end(), value);
    }
    /// New values are not initialized.
    void resize(size_t count) {
        if (count > _capacity) {
            _Grow(count);
        }
        _size = count;
    }
    void swap(InlineVector& other) {
        InlineVector kept = std::move(other);
        other = std::move(*this);
        *this = std::move(kept);
    }

  private:
    void _Grow(size_t capacity) {
        std::unique_ptr<T[]> heap(new T[capacity]);
        std::copy(begin(), end(), heap.get());
        _heap = std::move(heap);
        _capacity = capacity;
    }

    T _values[N];
    std::unique_ptr<T[]> _heap;
    size_t _size = 0;
    size_t _capacity = N;
};

}  // namespace cc
