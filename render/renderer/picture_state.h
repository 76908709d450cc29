// PictureState: how far the picture is that a Renderer shows, and what the targets of its passes hold of it. A value
// without GL: the renderer tells it what has happened, and asks it what may be done.
//
//   event            from which stage to which; all other stages stay as they are
//   begin            any -> kPartial, or kPartialOverCast where the caster's picture is shown
//   finish           kPartial, kPartialOverCast -> kDrawn
//   interrupt        kPartial -> kAbandoned, kPartialOverCast -> kCast, kRefining -> kDrawn, kFiner -> kFineInParts
//   shade            any that is held() -> kDrawn
//   shade_changed    kRefining -> kDrawn; kFiner, kFine -> kFineInParts
//   begin_refining   kDrawn, kFineInParts -> kRefining
//   show_mean        kRefining -> kFiner
//   end_refining     any that can_refine() -> kFine
//   cast, lose       any -> kCast, kEmpty
#pragma once

#include <cstdint>

namespace ramus::render {

class PictureState {
public:
    enum class Stage : std::uint8_t {
        kEmpty,           // there is no picture
        kPartial,         // the next one is being drawn into the targets, in parts; the one before is shown
        kPartialOverCast, // the same, where the one before is the caster's
        kAbandoned,       // that was given up: a picture is shown that the targets do not hold
        kCast,            // the caster's picture
        kDrawn,           // the passes' picture, one view
        kRefining,        // the same, while further views are added up
        kFiner,           // the mean of some views, while more are added
        kFine,            // as fine as it gets
        kFineInParts,     // a mean of views, but for branches that were shaded again since
    };

    [[nodiscard]] Stage stage() const { return stage_; }
    // Whether a picture is on its way in parts.
    [[nodiscard]] bool partial() const { return is(Stage::kPartial) || is(Stage::kPartialOverCast); }
    // Whether the caster made what is shown: it says what lies under a pixel.
    [[nodiscard]] bool by_caster() const { return is(Stage::kCast) || is(Stage::kPartialOverCast); }
    // Whether the targets hold what is shown: shading alone changes its colours, and they say what lies under a pixel.
    [[nodiscard]] bool held() const;
    // Whether what lies under a pixel can be told now.
    [[nodiscard]] bool answers() const { return by_caster() || held(); }
    [[nodiscard]] bool can_refine() const { return held() && !is(Stage::kFine); }
    [[nodiscard]] bool refining() const { return is(Stage::kRefining) || is(Stage::kFiner); }

    // What has happened.
    void lose() { stage_ = Stage::kEmpty; } // memory ran out, or drawing failed
    void begin();                           // the first part of a picture goes into the targets
    void interrupt();                       // what was on its way, picture or mean, is given up
    void finish();                          // a picture is whole, shaded and shown
    void shade();                           // all of what is held was shaded again
    void shade_changed();                   // some branches of what is held were
    void cast() { stage_ = Stage::kCast; }  // the caster has made a picture, and it is shown
    void begin_refining();
    void show_mean();
    void end_refining(); // there are no more views, or no memory for them

private:
    [[nodiscard]] bool is(Stage stage) const { return stage_ == stage; }
    Stage stage_ = Stage::kEmpty;
};

} // namespace ramus::render
