#ifndef HDCC_RENDER_STATS_H
#define HDCC_RENDER_STATS_H

#include "pxr/base/vt/dictionary.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

struct HdCCFrame;

/// The numbers of a frame, laid out as tools/record's --stats file.
VtDictionary HdCCRenderStats(HdCCFrame const &frame);

PXR_NAMESPACE_CLOSE_SCOPE

#endif
