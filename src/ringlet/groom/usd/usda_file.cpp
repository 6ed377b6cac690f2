// Implements groom/usd/usda_file.h.
//
//   #usda 1.0
//   ( upAxis = "Y" ... )                              the layer's metadata
//   def BasisCurves "Hair" ( active = true ... )      a prim, its type and metadata
//   {
//       uniform token type = "cubic"                  attributes
//       point3f[] points = [(0, 0, 0), ...] ( ... )
//       point3f[] points.timeSamples = { 1: [...], 2: [...] }
//       def Xform "Inner" { ... }                     prims below it
//       variantSet "look" = { "a" { ... } ... }
//   }
#include "ringlet/groom/usd/usda_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "ringlet/base/quoted.h"

namespace ringlet {
namespace {

constexpr std::string_view kCookie = "#usda 1.";  // with any minor version; to the parser a comment
constexpr std::size_t kDeepestBracket = 256;
constexpr std::size_t kWidestElement = 16;  // a matrix
constexpr std::array<std::string_view, 5> kListEdits{"prepend", "append", "add", "delete", "reorder"};

bool isOfWord(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         byte >= 0x80;
}
bool isOfNumber(char c) { return isOfWord(c) || c == '+' || c == '-' || c == '.'; }

char closingOf(char open) { return open == '(' ? ')' : open == '[' ? ']' : '}'; }

template <class Range>
bool holds(const Range& range, std::string_view word) {
  return std::ranges::find(range, word) != std::end(range);
}

class UsdaReader {
 public:
  UsdaReader(std::string_view text, const std::string& name, UsdContent content)
      : text_(text), name_(name), content_(content) {}

  Result<UsdLayer> read() {
    if (!isUsda(text_)) return wanted("'#usda 1.0'");
    if (peek() == '(') {
      if (Status read = readLayerMetadata(); !read) return read.error();
    }
    if (Status read = readContents(); !read) return read.error();
    return std::move(layer_);
  }

 private:
  // --- Characters.

  // The next character that is none of space and comment; '\0' at the end.
  char peek() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') {
        ++line_;
      } else if (c == '#' || text_.substr(at_, 2) == "//") {
        at_ = std::min(text_.find('\n', at_), text_.size());
        continue;
      } else if (text_.substr(at_, 2) == "/*") {
        const std::size_t end = text_.find("*/", at_ + 2);
        const std::size_t stop = end == text_.npos ? text_.size() : end + 2;
        countLines(stop);
        at_ = stop;
        continue;
      } else if (c != ' ' && c != '\t' && c != '\r' && c != '\v' && c != '\f') {
        return c;
      }
      ++at_;
    }
    return '\0';
  }
  bool isAtEnd() {
    peek();
    return at_ >= text_.size();
  }
  bool accept(char c) {
    if (isAtEnd() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void countLines(std::size_t end) {
    line_ += static_cast<std::size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                 text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
  }

  std::string_view takeWhile(bool (*isPart)(char)) {
    peek();
    const std::size_t start = at_;
    while (at_ < text_.size() && isPart(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
  }
  std::string_view takeWord() { return takeWhile(isOfWord); }
  // Names of properties and types: "primvars:id", "half3[]" without its brackets.
  std::string_view takeName() {
    return takeWhile([](char c) { return isOfWord(c) || c == ':'; });
  }

  Error wanted(std::string_view what) {
    const std::string found = isAtEnd() ? "the end of the file" : quoted(text_.substr(at_, 33));
    return Error{fmt::format("{}: line {}: found {}; expected {}", name_, line_, found, what)};
  }

  // --- Values that only must end.

  // A quoted string, an asset's @name@ or a </path>: what stands between.
  Result<std::string_view> takeDelimited() {
    const char open = text_[at_];
    const bool isLong = open != '<' && text_.substr(at_, 3) == std::string(3, open);
    const std::string close = open == '<' ? ">" : std::string(isLong ? 3 : 1, open);
    const std::size_t start = at_ + close.size();
    std::size_t end = start;
    while (end < text_.size() && text_.substr(end, close.size()) != close) {
      if (text_[end] == '\n' && !isLong) end = text_.size();
      end += end < text_.size() && text_[end] == '\\' && open != '<' && open != '@' ? 2 : 1;
    }
    if (end >= text_.size()) {
      return Error{fmt::format("{}: line {}: found {} without its end; expected another {}", name_, line_,
                               quoted(text_.substr(at_, 33)), quoted(std::string_view(close)))};
    }
    const std::string_view inner = text_.substr(start, end - start);
    countLines(end);
    at_ = end + close.size();
    return inner;
  }
  // What a string says: \" is ", \n a line break.
  std::string_view withoutEscapes(std::string_view text) {
    if (text.find('\\') == text.npos) return text;
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const bool isEscaped = text[i] == '\\' && i + 1 < text.size();
      const char c = text[isEscaped ? ++i : i];
      plain += !isEscaped ? c : c == 'n' ? '\n' : c == 't' ? '\t' : c;
    }
    return layer_.targets.emplace_back(std::move(plain));
  }
  static bool isDelimiter(char c) { return c == '"' || c == '\'' || c == '@' || c == '<'; }

  // From the bracket here to the one that closes it. Says whether there was anything in it.
  Result<bool> skipBrackets() {
    std::string open;
    bool isFilled = false;
    do {
      const char c = peek();
      if (isAtEnd()) return wanted(fmt::format("'{}'", closingOf(open.back())));
      if (c == '(' || c == '[' || c == '{') {
        if (open.size() == kDeepestBracket)
          return wanted(fmt::format("at most {} brackets in each other", kDeepestBracket));
        open += c;
        ++at_;
      } else if (c == ')' || c == ']' || c == '}') {
        if (c != closingOf(open.back())) return wanted(fmt::format("'{}'", closingOf(open.back())));
        open.pop_back();
        ++at_;
      } else if (isDelimiter(c)) {
        if (auto inner = takeDelimited(); !inner) return inner.error();
      } else {
        ++at_;
      }
      isFilled |= open.size() == 1 && c != open.front();
    } while (!open.empty());
    return isFilled;
  }

  // Any value, with what may stand behind one: @asset@</prim> (offset = 1). Says whether it holds something.
  Result<bool> skipValue() {
    const char c = peek();
    if (c == '(' || c == '[' || c == '{') return skipBrackets();
    if (!isDelimiter(c)) {
      const std::string_view word = takeWhile(isOfNumber);
      if (word.empty()) return wanted("a value");
      return word != "None";
    }
    while (isDelimiter(peek())) {
      if (auto inner = takeDelimited(); !inner) return inner.error();
      if (c == '"' || c == '\'') return true;
    }
    if (peek() == '(') {
      if (auto skipped = skipBrackets(); !skipped) return skipped;
    }
    return true;
  }

  // --- Values that count.

  Result<double> takeNumber() {
    peek();
    const std::size_t start = at_;
    std::string_view word = takeWhile(isOfNumber);
    if (word.size() > 1 && word.front() == '+') word.remove_prefix(1);
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, code] = std::from_chars(word.data(), end, value);
    if (word == "true" || word == "false") return word == "true" ? 1.0 : 0.0;
    const bool isTiny = code == std::errc::result_out_of_range && stop == end &&
                        (word.find("e-") != word.npos || word.find("E-") != word.npos);
    if (isTiny) return 0.0;
    if (code != std::errc() || stop != end) {
      at_ = start;
      return wanted("a number");
    }
    return value;
  }

  // (1, 2, 3) or ((1, 0), (0, 1)), whose numbers are appended.
  Status readTuple(std::vector<double>& numbers) {
    std::size_t depth = 0;
    const std::size_t before = numbers.size();
    do {
      if (accept('(')) {
        if (++depth > 2) return wanted("a number");
        continue;
      }
      auto number = takeNumber();
      if (!number) return number.error();
      numbers.push_back(*number);
      if (numbers.size() - before > kWidestElement)
        return wanted(fmt::format("a tuple of at most {} numbers", kWidestElement));
      while (depth > 0 && accept(')')) --depth;
      if (depth > 0 && !accept(',')) return wanted("',' or ')'");
      while (depth > 0 && accept(')')) --depth;
    } while (depth > 0);
    return {};
  }

  Status readElement(UsdValue& value) {
    const char c = peek();
    if (c == '"' || c == '\'' || c == '@') {
      auto text = takeDelimited();
      if (!text) return text.error();
      value.texts.push_back(c == '@' ? *text : withoutEscapes(*text));
      return {};
    }
    const std::size_t before = value.numbers.size();
    if (Status read = readTuple(value.numbers); !read) return read;
    const std::size_t width = value.numbers.size() - before;
    if (before == 0) value.width = width;
    if (width != value.width) {
      return Error{fmt::format("{}: line {}: found an element of {} numbers; expected {}, as before it",
                               name_, line_, width, value.width)};
    }
    return {};
  }

  Status readValue(UsdValue& value) {
    value = {};
    peek();
    if (text_.substr(at_, 4) == "None" && (at_ + 4 >= text_.size() || !isOfWord(text_[at_ + 4]))) {
      at_ += 4;
      value.isBlocked = true;
      return {};
    }
    if (!accept('[')) return readElement(value);
    while (!accept(']')) {
      if (Status read = readElement(value); !read) return read;
      if (!accept(',') && peek() != ']') return wanted("',' or ']'");
    }
    return {};
  }

  // { 1: value, 2: value }: the earliest is kept, of what may begin empty the earliest that is not.
  // All samples, put in order.
  Status readEverySample(UsdAttribute& attribute) {
    if (!accept('{')) return wanted("'{'");
    while (!accept('}')) {
      auto time = takeNumber();
      if (!time) return time.error();
      if (!std::isfinite(*time)) return wanted("a finite time");
      if (!accept(':')) return wanted("':'");
      UsdSample& sample = attribute.samples.emplace_back(UsdSample{.time = *time});
      if (Status read = readValue(sample.value); !read) return read;
      if (!accept(',') && peek() != '}') return wanted("',' or '}'");
    }
    std::ranges::stable_sort(attribute.samples, {}, &UsdSample::time);
    if (attribute.samples.empty()) return {};
    attribute.isSampled = attribute.samples.size() > 1;
    attribute.time = attribute.samples.front().time;
    attribute.value = attribute.samples.front().value;
    return {};
  }

  Status readSamples(UsdAttribute& attribute) {
    if (keepsUsdSamples(content_)) return readEverySample(attribute);
    if (!accept('{')) return wanted("'{'");
    const bool mayBeEmpty = mayBeginEmpty(attribute.name);
    const auto isEmpty = [](const UsdValue& value) { return value.numbers.empty() && value.texts.empty(); };
    std::size_t count = 0;
    while (!accept('}')) {
      auto time = takeNumber();
      if (!time) return time.error();
      if (!std::isfinite(*time)) return wanted("a finite time");
      if (!accept(':')) return wanted("':'");
      const bool isFirst = ++count == 1, keptIsEmpty = mayBeEmpty && isEmpty(attribute.value);
      if (isFirst || *time < *attribute.time || keptIsEmpty) {
        UsdValue value;
        if (Status read = readValue(value); !read) return read;
        const bool isNothing = mayBeEmpty && isEmpty(value);
        if (isNothing) attribute.emptyTime = std::min(*time, attribute.emptyTime.value_or(*time));
        if (isFirst || (isNothing == keptIsEmpty ? *time < *attribute.time : keptIsEmpty)) {
          attribute.time = *time;
          attribute.value = std::move(value);
        }
      } else if (auto skipped = skipValue(); !skipped) {
        return skipped.error();
      }
      if (!accept(',') && peek() != '}') return wanted("',' or '}'");
    }
    attribute.isSampled = count > 1;
    if (attribute.emptyTime && *attribute.emptyTime >= *attribute.time) attribute.emptyTime.reset();
    return {};
  }

  // --- The layer.

  // "key = value", or a string that is a comment; `edit` is "prepend", "delete" ... or empty.
  template <class Take>
  Status readMetadata(Take take) {
    accept('(');
    while (!accept(')')) {
      if (accept(';') || accept(',')) continue;
      if (isDelimiter(peek())) {
        if (auto comment = takeDelimited(); !comment) return comment.error();
        continue;
      }
      std::string_view key = takeName(), edit;
      if (holds(kListEdits, key)) {
        edit = key;
        key = takeName();
      }
      if (key.empty()) return wanted("a name or ')'");
      if (!accept('=')) return wanted("'='");
      if (Status taken = take(edit, key); !taken) return taken;
    }
    return {};
  }

  // Notes a field that brings in other prims, unless it is empty or only takes away.
  Status noteComposition(std::string_view edit, std::string_view key, std::string_view& composedBy) {
    const auto isFilled = skipValue();
    if (!isFilled) return isFilled.error();
    if (*isFilled && edit != "delete" && edit != "reorder" && composedBy.empty()) composedBy = key;
    return {};
  }

  Status readLayerMetadata() {
    return readMetadata([&](std::string_view edit, std::string_view key) -> Status {
      if (key == "upAxis" && (peek() == '"' || peek() == '\'')) {
        auto axis = takeDelimited();
        if (!axis) return axis.error();
        layer_.upAxis = *axis;
        return {};
      }
      if (key == "metersPerUnit") {
        auto number = takeNumber();
        if (!number) return number.error();
        layer_.metresPerUnit = *number;
        return {};
      }
      if (key == "timeCodesPerSecond") {
        auto number = takeNumber();
        if (!number) return number.error();
        layer_.timeCodesPerSecond = *number;
        return {};
      }
      if (holds(std::array<std::string_view, 2>{"subLayers", "relocates"}, key))
        return noteComposition(edit, key, layer_.composedBy);
      const auto skipped = skipValue();
      return skipped ? Status{} : Status{skipped.error()};
    });
  }

  Status readPrimMetadata(UsdPrim& prim) {
    return readMetadata([&](std::string_view edit, std::string_view key) -> Status {
      constexpr std::array<std::string_view, 8> kComposing{"references",  "payload",     "inherits",
                                                           "specializes", "variantSets", "variants",
                                                           "clips",       "relocates"};
      if (key == "active") {
        auto number = takeNumber();
        if (!number) return number.error();
        prim.isActive = *number != 0;
        return {};
      }
      if (content_ == UsdContent::meshes && key == "clips") return readClips(prim.clips);
      if (content_ == UsdContent::meshes && key == "clipSets") return readNames(edit, prim.clipSets);
      if (holds(kComposing, key)) return noteComposition(edit, key, prim.composedBy);
      const auto skipped = skipValue();
      return skipped ? Status{} : Status{skipped.error()};
    });
  }

  // { type key = value ... }; `take` reads the value. A dictionary has at most kMostUsdEntries.
  template <class Take>
  Status readDictionary(Take take) {
    if (!accept('{')) return wanted("'{'");
    for (std::size_t count = 0; !accept('}');) {
      if (accept(';') || accept(',')) continue;
      if (++count > kMostUsdEntries)
        return wanted(fmt::format("at most {} entries of a dictionary", kMostUsdEntries));
      if (takeName().empty()) return wanted("the type of an entry, or '}'");
      if (accept('[') && !accept(']')) return wanted("']'");
      auto key = takeKey();
      if (!key) return key.error();
      if (!accept('=')) return wanted("'='");
      if (Status taken = take(*key); !taken) return taken;
    }
    return {};
  }
  Result<std::string_view> takeKey() {
    const char c = peek();
    if (c == '"' || c == '\'') return takeDelimited();
    const std::string_view key = takeName();
    if (key.empty()) return wanted("the name of an entry");
    return key;
  }

  Status readClips(std::vector<UsdClipSet>& sets) {
    if (peek() != '{') return skipped();  // None
    return readDictionary([&](std::string_view name) -> Status {
      UsdClipSet& set = sets.emplace_back(UsdClipSet{.name = name});
      set.isDictionary = peek() == '{';
      if (!set.isDictionary) return skipped();
      return readDictionary([&](std::string_view key) -> Status {
        UsdEntry& entry = set.entries.emplace_back(UsdEntry{.key = key});
        entry.isDictionary = peek() == '{';
        return entry.isDictionary ? skipped() : readValue(entry.value);
      });
    });
  }
  Status skipped() {
    const auto done = skipValue();
    return done ? Status{} : Status{done.error()};
  }

  Status readNames(std::string_view edit, std::vector<UsdNameEdit>& edits) {
    UsdValue value;
    if (Status read = readValue(value); !read) return read;
    edits.push_back({edit, std::move(value.texts)});
    return {};
  }

  // Prims and properties, down and up again, to the end of the file.
  Status readContents() {
    std::uint32_t parent = kNoUsdPrim;
    std::size_t depth = 0;
    while (!isAtEnd()) {
      if (accept(';') || accept(',')) continue;
      if (accept('}')) {
        if (parent == kNoUsdPrim) {
          --at_;
          return wanted("a prim");
        }
        parent = layer_.prims[parent].parent;
        --depth;
        continue;
      }
      const std::size_t start = at_;
      const std::string_view word = takeName();
      if (word == "def" || word == "over" || word == "class") {
        if (++depth > kDeepestUsdPrim)
          return wanted(fmt::format("at most {} prims in each other", kDeepestUsdPrim));
        if (Status begun = beginPrim(word, parent); !begun) return begun;
        parent = static_cast<std::uint32_t>(layer_.prims.size() - 1);
      } else if (word == "reorder" && isReordering()) {
        if (Status skipped = skipReordering(); !skipped) return skipped;
      } else if (parent == kNoUsdPrim) {
        at_ = start;
        return wanted("a prim: 'def', 'over' or 'class'");
      } else if (word == "variantSet") {
        if (Status skipped = skipVariants(layer_.prims[parent]); !skipped) return skipped;
      } else {
        at_ = start;
        if (Status read = readProperty(layer_.prims[parent]); !read) return read;
      }
    }
    return parent == kNoUsdPrim ? Status{} : Status{wanted("'}'")};
  }

  Status beginPrim(std::string_view specifier, std::uint32_t parent) {
    UsdPrim prim;
    prim.parent = parent;
    prim.specifier = specifier == "def"    ? UsdSpecifier::def
                     : specifier == "over" ? UsdSpecifier::over
                                           : UsdSpecifier::abstract;
    prim.type = takeName();
    if (peek() != '"' && peek() != '\'') return wanted("the prim's name in quotes");
    auto name = takeDelimited();
    if (!name) return name.error();
    prim.name = *name;
    if (peek() == '(') {
      if (Status read = readPrimMetadata(prim); !read) return read;
    }
    if (!accept('{')) return wanted("'{'");
    if (layer_.prims.size() == kNoUsdPrim) return wanted("fewer prims");
    layer_.prims.push_back(std::move(prim));
    return {};
  }

  // "reorder nameChildren = [...]" stands for itself; "reorder rel x = ..." is a property's.
  bool isReordering() {
    peek();
    for (const std::string_view word : {"nameChildren", "rootPrims", "properties"}) {
      if (text_.substr(at_, word.size()) == word) return true;
    }
    return false;
  }
  Status skipReordering() {
    takeName();
    if (!accept('=')) return wanted("'='");
    const auto skipped = skipValue();
    return skipped ? Status{} : Status{skipped.error()};
  }

  Status skipVariants(UsdPrim& prim) {
    if (peek() != '"' && peek() != '\'') return wanted("the variant set's name in quotes");
    if (auto name = takeDelimited(); !name) return name.error();
    if (!accept('=')) return wanted("'='");
    if (peek() != '{') return wanted("'{'");
    const auto isFilled = skipBrackets();
    if (!isFilled) return isFilled.error();
    if (*isFilled && prim.composedBy.empty()) prim.composedBy = "variantSet";
    return {};
  }

  Status readProperty(UsdPrim& prim) {
    constexpr std::array<std::string_view, 4> kQualities{"custom", "uniform", "varying", "config"};
    std::string_view type = takeName();
    bool takesAway = false;  // "delete rel x"
    for (; holds(kListEdits, type) || holds(kQualities, type); type = takeName())
      takesAway |= type == "delete" || type == "reorder";
    if (type.empty()) return wanted("a property, a prim or '}'");
    const std::size_t typeAt = at_ - type.size();
    if (accept('[')) {
      if (!accept(']')) return wanted("']'");
      type = text_.substr(typeAt, at_ - typeAt);
    }
    const std::string_view name = takeName();
    if (name.empty()) return wanted("a property's name");
    const std::string_view part = accept('.') ? takeName() : "";

    UsdAttribute* attribute = nullptr;
    const bool isRelationship = type == "rel";
    if (isRelationship ? isKeptUsdRelationship(name, content_) && !takesAway
                       : isKeptUsdAttribute(prim.type, name, content_)) {
      auto kept = attributeOf(prim, name);
      if (!kept) return kept.error();
      attribute = *kept;
      attribute->type = type;
    }
    if (accept('=')) {
      const auto isFilled =
          isRelationship && attribute ? readTargets(*attribute) : readPropertyValue(attribute, part);
      if (!isFilled) return isFilled.error();
      if (*isFilled && !takesAway && isUsdDeformation(name) && prim.deformedBy.empty())
        prim.deformedBy = name;
    }
    if (peek() != '(') return {};
    if (attribute && isUsdValue(name)) return readInterpolation(*attribute);
    const auto skipped = skipBrackets();
    return skipped ? Status{} : Status{skipped.error()};
  }

  Status readInterpolation(UsdAttribute& attribute) {
    return readMetadata([&](std::string_view, std::string_view key) -> Status {
      if (key == "interpolation" && (peek() == '"' || peek() == '\'')) {
        auto interpolation = takeDelimited();
        if (!interpolation) return interpolation.error();
        attribute.interpolation = *interpolation;
        return {};
      }
      const auto skipped = skipValue();
      return skipped ? Status{} : Status{skipped.error()};
    });
  }

  // </Path>, a list of such, or None. A second line of the same relationship adds to the first.
  Result<bool> readTargets(UsdAttribute& relationship) {
    std::vector<std::string_view>& targets = relationship.value.texts;
    const auto readTarget = [&]() -> Status {
      if (peek() != '<') return wanted("a path, as in </Root/Skeleton>");
      auto target = takeDelimited();
      if (!target) return target.error();
      targets.push_back(*target);
      return {};
    };
    Status read;
    peek();
    if (text_.substr(at_, 4) == "None") {
      at_ += 4;
    } else if (!accept('[')) {
      read = readTarget();
    } else {
      while (read && !accept(']')) {
        read = readTarget();
        if (read && !accept(',') && peek() != ']') return wanted("',' or ']'");
      }
    }
    if (!read) return read.error();
    relationship.value.isBlocked = targets.empty();
    return !targets.empty();
  }

  // Samples count more than the default, whichever stands first. Says whether it holds something.
  Result<bool> readPropertyValue(UsdAttribute* attribute, std::string_view part) {
    Status read;
    if (attribute && part == "timeSamples") {
      read = readSamples(*attribute);
    } else if (attribute && (part.empty() || part == "default") && !attribute->time) {
      read = readValue(attribute->value);
    } else {
      return skipPropertyValue(attribute, part);
    }
    if (!read) return read.error();
    return !attribute->value.numbers.empty() || !attribute->value.texts.empty();
  }
  Result<bool> skipPropertyValue(UsdAttribute* attribute, std::string_view part) {
    const auto isFilled = skipValue();
    if (!isFilled) return isFilled;
    if (attribute && *isFilled && part == "connect") attribute->drivenBy = "a connection";
    if (attribute && *isFilled && part == "spline") attribute->drivenBy = "a spline";
    return isFilled;
  }

  Result<UsdAttribute*> attributeOf(UsdPrim& prim, std::string_view name) {
    const auto found = std::ranges::find(prim.attributes, name, &UsdAttribute::name);
    if (found != prim.attributes.end()) return &*found;
    if (prim.attributes.size() == kMostUsdAttributes)
      return wanted(fmt::format("at most {} transforms of a prim", kMostUsdAttributes));
    prim.attributes.push_back({.name = name});
    return &prim.attributes.back();
  }

  std::string_view text_;
  const std::string& name_;
  UsdContent content_;
  std::size_t at_ = 0, line_ = 1;
  UsdLayer layer_;
};

}  // namespace

bool isUsda(std::string_view text) { return text.starts_with(kCookie); }

Result<UsdLayer> readUsda(std::string_view text, const std::string& name, UsdContent content) {
  return UsdaReader(text, name, content).read();
}

}  // namespace ringlet
