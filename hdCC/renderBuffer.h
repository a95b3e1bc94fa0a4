#ifndef HDCC_RENDER_BUFFER_H
#define HDCC_RENDER_BUFFER_H

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/render/film.h"

#include "pxr/base/gf/rect2i.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/renderBuffer.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Pixels in memory, in any of Hydra's formats of plain numbers; row 0 is the bottom.
class HdCCRenderBuffer final : public HdRenderBuffer {
  public:
    explicit HdCCRenderBuffer(SdfPath const &id);

    bool Allocate(GfVec3i const &dimensions, HdFormat format, bool multiSampled) override;
    unsigned int GetWidth() const override { return _width; }
    unsigned int GetHeight() const override { return _height; }
    unsigned int GetDepth() const override { return 1; }
    HdFormat GetFormat() const override { return _format; }
    bool IsMultiSampled() const override { return false; }

    void *Map() override;
    void Unmap() override { --_mappers; }
    bool IsMapped() const override { return _mappers > 0; }
    void Resolve() override {}
    bool IsConverged() const override { return _converged; }
    void SetConverged(bool converged) { _converged = converged; }

    /// Another one whenever the pixels are lost, which no other buffer has had.
    int GetVersion() const { return _version; }

    /// Fills the buffer with a value of numbers; an empty value leaves it as it is.
    void Clear(VtValue const &value);

    /// Copies an AOV of the film to the pixels from `corner` on. Where the film shows nothing,
    /// `clearValue` shows, unless it is empty.
    /// @param corner  may be anywhere: what falls outside is cropped
    void Write(cc::Film const &film, cc::Aov const &aov, GfVec2i const &corner,
               VtValue const &clearValue);

  protected:
    void _Deallocate() override;

  private:
    unsigned int _width = 0, _height = 0;
    HdFormat _format = HdFormatInvalid;
    std::vector<uint8_t> _pixels;
    std::atomic<int> _mappers{0};
    std::atomic<bool> _converged{false};
    int _version = 0;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
