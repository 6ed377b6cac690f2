// Panel: the widgets beside the picture (Dear ImGui): buttons, a slider for every number, what is shown, how
// long it takes. It changes edits, and says what was asked for; others do it.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "view/edit_history.h"
#include "view/edits.h"
#include "view/sliders.h"

namespace ringlet::view {

inline constexpr int kPanelWidth = 320;  // [pixels], at the right of the window

/// What lies over the picture, and is switched on and off.
struct Shown {
  bool bodies = true, guides = false, stretch = false, contacts = false, frames = false;
};

/// What a person asked for since the last frame.
struct Asked {
  bool play = false, step = false, reset = false, home = false;
  bool undo = false, redo = false, save = false, picture = false, quit = false;
};

/// What the panel tells.
struct Facts {
  double framesPerSecond = 0;  // shown
  std::size_t frame = 0;
  double seconds = 0;  // of the scene
  bool isPlaying = true;
  bool canShowGuides = false;                          // hairs are drawn that follow them
  std::string hair;                                    // "300 strands of 64 particles"
  std::string message;                                 // of what was done last, or of what failed
  std::vector<std::pair<std::string, double>> stages;  // [ms a frame]
};

/// Where a widget is in the window, for scripts that use it: left, top, width, height [pixels].
using WidgetPlaces = std::map<std::string, std::array<int, 4>>;

class Panel {
 public:
  Panel() : groups_(sliderGroups()) {}

  /// Draws it at the right of a window of that size, within an ImGui frame.
  void draw(int windowWidth, int windowHeight, const Facts& facts, EditHistory<Edits>& history, Shown& shown,
            Asked& asked);
  /// A key of the keyboard, as GLFW has it, does what a button does.
  void readKey(int key, int modifiers, EditHistory<Edits>& history, Shown& shown, Asked& asked);

  /// A slider of a number that builds the hair anew is being dragged: its number counts when it is let go.
  bool isHeld() const { return isHeld_; }
  bool isOpen = true;
  std::size_t material = 0;  // that sliders change: A is 0, B is 1
  const WidgetPlaces& places() const { return places_; }

 private:
  void drawButtons(const Facts& facts, EditHistory<Edits>& history, Asked& asked);
  void drawMaterials(EditHistory<Edits>& history);
  void drawGroup(const SliderGroup& group, EditHistory<Edits>& history);
  void drawSlider(const Slider& slider, EditHistory<Edits>& history);
  bool drawValue(const Slider& slider, bool isSet, double& value) const;
  void drawShown(const Facts& facts, Shown& shown, EditHistory<Edits>& history);
  void drawTimes(const Facts& facts);
  bool button(const char* name, const char* tip, bool isPossible = true);
  void note(const std::string& name);

  std::vector<SliderGroup> groups_;
  WidgetPlaces places_;
  bool isHeld_ = false;
};

}  // namespace ringlet::view
