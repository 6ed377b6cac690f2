// Implements view/panel.h.
#include "view/panel.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "ringlet/rest/material_presets.h"

namespace ringlet::view {
namespace {

constexpr float kValueWidth = 120;

void explain(const std::string& text) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(280);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

std::string tipOf(const Slider& slider) {
  std::string tip = slider.effect;
  if (slider.kind == Slider::Kind::number || slider.kind == Slider::Kind::whole)
    tip += fmt::format("\nFrom {:g} to {:g}{}{}; Ctrl+click types a number, a right click takes {:g}.",
                       slider.allowed.low, slider.allowed.high, slider.unit.empty() ? "" : " ", slider.unit,
                       slider.standard);
  if (!slider.isLive) tip += "\n* The hair is built anew, where it is, when this changes.";
  return tip;
}

}  // namespace

void Panel::note(const std::string& name) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_[name] = {static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(high.x - low.x),
                   static_cast<int>(high.y - low.y)};
}

bool Panel::button(const char* name, const char* tip, bool isPossible) {
  ImGui::BeginDisabled(!isPossible);
  const bool isPressed = ImGui::Button(name);
  ImGui::EndDisabled();
  note(name);
  explain(tip);
  ImGui::SameLine();
  return isPressed;
}

void Panel::drawButtons(const Facts& facts, EditHistory<Edits>& history, Asked& asked) {
  asked.play |= button(facts.isPlaying ? "pause" : "play", "Space");
  asked.step |= button("step", "One frame: the full stop", !facts.isPlaying);
  asked.reset |= button("reset", "All hair at rest, the head back in its place: R");
  asked.undo |= button("undo", "Ctrl+Z", history.canUndo());
  asked.redo |= button("redo", "Ctrl+Y", history.canRedo());
  ImGui::NewLine();
  asked.save |= button("save", "Writes the scene with these numbers: Ctrl+S");
  asked.picture |= button("picture", "Writes the window as a PNG: F12");
  asked.home |= button("home", "The camera back to where it was: H");
  ImGui::NewLine();
  ImGui::TextUnformatted(
      fmt::format("{:.1f} frames/s   frame {}   {:.2f} s", facts.framesPerSecond, facts.frame, facts.seconds)
          .c_str());
  ImGui::TextUnformatted(facts.hair.c_str());
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(facts.message.c_str());
  ImGui::PopTextWrapPos();
}

// Which material sliders change, and what it starts from.
void Panel::drawMaterials(EditHistory<Edits>& history) {
  Edits edits = history.now();
  bool isChanged = ImGui::Checkbox("A|B", &edits.compares);
  note("compare");
  explain("Two materials side by side: A at the left, B at the right.");
  if (!edits.compares) material = 0;
  for (std::size_t which = 0; which < 2 && edits.compares; ++which) {
    ImGui::SameLine();
    if (ImGui::RadioButton(which == 0 ? "A" : "B", material == which)) material = which;
    note(which == 0 ? "A" : "B");
  }
  ImGui::SameLine();
  ImGui::SetNextItemWidth(kValueWidth);
  if (ImGui::BeginCombo("##preset", "preset")) {
    for (const std::string& name : presetNames()) {
      if (ImGui::Selectable(name.c_str())) {
        edits.materials[material] = {*materialPreset(name), {}};
        isChanged = true;
      }
      note("preset." + name);
      explain(presetSummary(name));
    }
    ImGui::EndCombo();
  }
  note("preset");
  if (!isChanged) return;
  history.set(edits);
  history.commit();
}

bool Panel::drawValue(const Slider& slider, bool isSet, double& value) const {
  const std::string id = "##" + slider.name;
  if (slider.kind == Slider::Kind::toggle) {
    bool isOn = value > 0.5;
    const bool isChanged = ImGui::Checkbox(id.c_str(), &isOn);
    value = isOn ? 1 : 0;
    return isChanged;
  }
  if (slider.kind == Slider::Kind::choice) {
    int choice = static_cast<int>(value);
    std::string names;
    for (const std::string& name : slider.choices) names += name + '\0';
    const bool isChanged = ImGui::Combo(id.c_str(), &choice, names.c_str());
    value = choice;
    return isChanged;
  }
  const bool isWhole = slider.kind == Slider::Kind::whole;
  const ImGuiSliderFlags flags =
      slider.isLogarithmic ? ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoRoundToFormat : 0;
  const bool isChanged =
      ImGui::SliderScalar(id.c_str(), ImGuiDataType_Double, &value, &slider.shown.low, &slider.shown.high,
                          !isSet    ? "as is best"
                          : isWhole ? "%.0f"
                                    : "%.4g",
                          flags);
  if (isWhole) value = std::round(value);
  value = std::clamp(value, slider.allowed.low, slider.allowed.high);
  return isChanged;
}

void Panel::drawSlider(const Slider& slider, EditHistory<Edits>& history) {
  Edits edits = history.now();
  if (!isInUse(slider, edits)) return;
  const std::optional<double> set = slider.get(edits, material);
  double value = set.value_or(slider.standard);
  ImGui::SetNextItemWidth(kValueWidth);
  bool isChanged = drawValue(slider, set.has_value(), value);
  const bool isLetGo = ImGui::IsItemDeactivatedAfterEdit();
  const bool isActive = ImGui::IsItemActive();
  note(slider.name);
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) value = slider.standard, isChanged = true;
  const bool isAtOnce = isChanged && !isActive;  // a checkbox, a choice, a right click
  explain(tipOf(slider));
  ImGui::SameLine();
  ImGui::TextUnformatted(fmt::format("{}{}{}{}", slider.label, slider.unit.empty() ? "" : " ", slider.unit,
                                     slider.isLive ? "" : " *")
                             .c_str());
  explain(tipOf(slider));
  if (isActive && !slider.isLive) isHeld_ = true;
  if (isChanged) {
    slider.set(edits, material, value);
    history.set(edits);
  }
  if (isLetGo || isAtOnce) history.commit();
}

void Panel::drawGroup(const SliderGroup& group, EditHistory<Edits>& history) {
  const bool isOpenTab = ImGui::BeginTabItem(group.title.c_str());
  note("tab." + group.title);
  if (!isOpenTab) return;
  ImGui::BeginChild("sliders");
  if (group.title == "hair") drawMaterials(history);
  std::string table = group.sliders.front().table;
  for (const Slider& slider : group.sliders) {
    if (slider.table != table) ImGui::TextDisabled("[%s]", slider.table.c_str());
    table = slider.table;
    drawSlider(slider, history);
  }
  ImGui::EndChild();
  ImGui::EndTabItem();
}

void Panel::drawShown(const Facts& facts, Shown& shown, EditHistory<Edits>&) {
  const bool isOpenTab = ImGui::BeginTabItem("show");
  note("tab.show");
  if (!isOpenTab) return;
  const auto box = [&](const char* name, bool& isOn, const char* tip, bool isPossible = true) {
    ImGui::BeginDisabled(!isPossible);
    ImGui::Checkbox(name, &isOn);
    ImGui::EndDisabled();
    note(std::string("show.") + name);
    explain(tip);
  };
  box("bodies", shown.bodies, "The head and the bodies of the scene: B");
  box("guides", shown.guides, "The simulated strands in place of the hairs that follow them: G",
      facts.canShowGuides);
  box("stretch", shown.stretch, "Strands by their longest edge, blue at rest, red from 5 % on: S");
  box("contacts", shown.contacts, "Particles that are in contact: C");
  box("frames", shown.frames, "Axes of the head and of the bodies, and of strands at their roots: F");
  ImGui::Separator();
  drawTimes(facts);
  ImGui::EndTabItem();
}

void Panel::drawTimes(const Facts& facts) {
  for (const auto& [name, milliseconds] : facts.stages)
    ImGui::TextUnformatted(fmt::format("{:>7.2f} ms  {}", milliseconds, name).c_str());
}

void Panel::draw(int windowWidth, int windowHeight, const Facts& facts, EditHistory<Edits>& history,
                 Shown& shown, Asked& asked) {
  places_.clear();
  isHeld_ = false;
  if (!isOpen) return;
  ImGui::SetNextWindowPos({static_cast<float>(windowWidth - kPanelWidth), 0});
  ImGui::SetNextWindowSize({static_cast<float>(kPanelWidth), static_cast<float>(windowHeight)});
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
  drawButtons(facts, history, asked);
  if (ImGui::BeginTabBar("tabs")) {
    for (const SliderGroup& group : groups_) drawGroup(group, history);
    drawShown(facts, shown, history);
    ImGui::EndTabBar();
  }
  ImGui::End();
}

void Panel::readKey(int key, int modifiers, EditHistory<Edits>& history, Shown& shown, Asked& asked) {
  if (ImGui::GetIO().WantTextInput) return;
  const bool isControl = modifiers & GLFW_MOD_CONTROL, isShift = modifiers & GLFW_MOD_SHIFT;
  const auto is = [&](int letter) { return key == letter; };
  if (isControl) {
    asked.undo |= is(GLFW_KEY_Z) && !isShift;
    asked.redo |= is(GLFW_KEY_Y) || (is(GLFW_KEY_Z) && isShift);
    asked.save |= is(GLFW_KEY_S);
    asked.quit |= is(GLFW_KEY_Q);
    return;
  }
  asked.play ^= is(GLFW_KEY_SPACE);
  asked.step |= is(GLFW_KEY_PERIOD);
  asked.reset |= is(GLFW_KEY_R);
  asked.home |= is(GLFW_KEY_H);
  asked.picture |= is(GLFW_KEY_F12);
  isOpen ^= is(GLFW_KEY_TAB);
  shown.bodies ^= is(GLFW_KEY_B);
  shown.guides ^= is(GLFW_KEY_G);
  shown.stretch ^= is(GLFW_KEY_S);
  shown.contacts ^= is(GLFW_KEY_C);
  shown.frames ^= is(GLFW_KEY_F);
  if (!is(GLFW_KEY_W)) return;
  Edits edits = history.now();
  edits.air.on = !edits.air.on;
  history.set(edits);
  history.commit();
}

}  // namespace ringlet::view
