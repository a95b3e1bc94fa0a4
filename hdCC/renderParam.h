#ifndef HDCC_RENDER_PARAM_H
#define HDCC_RENDER_PARAM_H

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "core/render/film.h"
#include "core/render/renderer.h"
#include "core/scene/scene.h"

#include "pxr/base/tf/token.h"
#include "pxr/base/vt/dictionary.h"
#include "pxr/imaging/hd/renderDelegate.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

#include "hdCC/renderThread.h"
#include "hdCC/shutter.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdCCShapeSync;

/// A picture and what it took.
struct HdCCFrame {
    cc::Film film;
    int samples = 0;      ///< that pixels have got; 0 if it is made of blocks
    bool isDone = false;  ///< no better picture of the frame will come
    cc::RenderOptions options;
    cc::RenderStatistics statistics;
    cc::Scene::Statistics scene;
    double syncSeconds = 0;
};

/// What the prims, the render passes and the delegate share: the scene, the thread that renders
/// it, and the last frame.
class HdCCRenderParam final : public HdRenderParam {
  public:
    cc::Scene *GetScene() { return &_scene; }

    /// Goes up with every change that the next picture shows.
    int GetSceneVersion() const { return _sceneVersion; }

    /// Put one before whatever edits the scene, as every Sync does: it makes a frame that renders
    /// let go of the scene, marks that as changed, and measures the phase.
    class SyncScope {
      public:
        explicit SyncScope(HdRenderParam *param);
        ~SyncScope();

      private:
        HdCCRenderParam *_param;
        std::chrono::steady_clock::time_point _begin;
    };

    /// Wall time from the first Sync to the last since this was last asked.
    double TakeSyncSeconds();

    /// Warns that `message`, about `id`, unless the same was said before.
    void WarnOnce(SdfPath const &id, std::string const &message);

    /// Shapes come and go with their prims; any thread may call.
    void AddShape(HdCCShapeSync *shape);
    void RemoveShape(HdCCShapeSync *shape);
    /// The prim of a shape, by the id that the AOV primId shows; empty if there is none.
    SdfPath FindPrim(int primId) const;
    /// Has all shapes sync a primvar from now on, those at once that have been synced already.
    /// Primvars that nobody asks for are left where they are.
    void AskForPrimvar(TfToken const &name);
    /// What AskForPrimvar was called for.
    TfTokenVector GetPrimvarsAskedFor() const;

    /// Has all shapes sync how they move while a shutter is open from now on, those at once that
    /// have been synced already. OpenUSD's older delegates give the samples of the shutter that the
    /// camera has when they are asked, so that those of a wider one do not hold for a narrower one.
    void AskForMotion(HdCCShutter const &shutter);
    /// What AskForMotion was last called for.
    HdCCShutter GetShutter() const;

    /// Renders in the background. Whoever changes what it reads abandons its job first.
    HdCCRenderThread &GetRenderThread() { return _renderThread; }

    /// The picture that was shown last; null before the first, and while a frame renders in one go.
    std::shared_ptr<const HdCCFrame> GetFrame() const;
    void SetFrame(std::shared_ptr<const HdCCFrame> frame);

    /// What the last command "pick" found.
    VtDictionary GetPicked() const;
    void SetPicked(VtDictionary const &picked);

    /// Pixels of the frame that renders, or of the last one, and samples done and to do.
    std::atomic<int64_t> pixels{0}, samplesDone{0}, samplesTotal{0};

  private:
    cc::Scene _scene;
    std::atomic<int> _sceneVersion{1};

    mutable std::mutex _mutex;
    std::chrono::steady_clock::time_point _syncBegin, _syncEnd;
    bool _synced = false;
    std::set<std::string> _warned;
    std::set<HdCCShapeSync *> _shapes;
    TfTokenVector _primvars;
    HdCCShutter _shutter;
    std::shared_ptr<const HdCCFrame> _frame;
    VtDictionary _picked;
    /// The last member: it ends first, as it reads the others.
    HdCCRenderThread _renderThread;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
