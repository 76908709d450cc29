// PictureState: state machine of the picture that a Renderer shows, and of what its render targets contain. A value
// without GL: the renderer reports events to it and queries what is possible.
//
//   event            transitions; an event does not change any other stage
//   begin            any -> kPartial, or kPartialOverCast if the caster's picture is shown
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
        kEmpty,           // no picture
        kPartial,         // the next picture is being drawn into the targets; the previous one is shown
        kPartialOverCast, // the same, and the previous one is the caster's
        kAbandoned,       // drawing was interrupted: the targets do not contain the shown picture
        kCast,            // the caster's picture
        kDrawn,           // the passes' picture, one view
        kRefining,        // the same, while further views are summed
        kFiner,           // the mean of some views, while more are added
        kFine,            // the mean of all views
        kFineInParts,     // a mean of views, except branches that were shaded again since
    };

    [[nodiscard]] Stage stage() const { return stage_; }
    // Whether a picture is being drawn in parts.
    [[nodiscard]] bool partial() const { return is(Stage::kPartial) || is(Stage::kPartialOverCast); }
    // Whether the shown picture is the caster's, which then answers picks.
    [[nodiscard]] bool by_caster() const { return is(Stage::kCast) || is(Stage::kPartialOverCast); }
    // Whether the targets contain the shown picture: its colours can change by shading alone, and they answer picks.
    [[nodiscard]] bool held() const;
    // Whether picks can be answered now.
    [[nodiscard]] bool answers() const { return by_caster() || held(); }
    [[nodiscard]] bool can_refine() const { return held() && !is(Stage::kFine); }
    [[nodiscard]] bool refining() const { return is(Stage::kRefining) || is(Stage::kFiner); }

    // Events.
    void lose() { stage_ = Stage::kEmpty; } // memory ran out, or drawing failed
    void begin();                           // drawing into the targets starts
    void interrupt();                       // the picture or the mean in progress is discarded
    void finish();                          // the picture is complete, shaded and shown
    void shade();                           // the held picture was shaded again
    void shade_changed();                   // some branches of it were shaded again
    void cast() { stage_ = Stage::kCast; }  // a picture of the caster is shown
    void begin_refining();
    void show_mean();
    void end_refining(); // no more views, or no memory for them

private:
    [[nodiscard]] bool is(Stage stage) const { return stage_ == stage; }
    Stage stage_ = Stage::kEmpty;
};

} // namespace ramus::render
