// Implements output/usd/usdc_head.h.
#include "ringlet/output/usd/usdc_head.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/base/half.h"
#include "ringlet/base/little_endian.h"
#include "ringlet/groom/usd/usdc_codec.h"

namespace ringlet {
namespace {

using namespace usdc;

void appendNumber(std::vector<std::byte>& bytes, Kind kind, double number) {
  switch (kind) {
    case Kind::boolean:
    case Kind::u8:
      bytes.push_back(static_cast<std::byte>(number));
      break;
    case Kind::half: {
      const std::uint16_t half = halfBits(static_cast<float>(number));
      bytes.push_back(static_cast<std::byte>(half & 255));
      bytes.push_back(static_cast<std::byte>(half >> 8));
      break;
    }
    case Kind::i32:
    case Kind::u32:
      appendU32(bytes, static_cast<std::uint32_t>(static_cast<std::int64_t>(number)));
      break;
    case Kind::i64:
    case Kind::u64:
      appendU64(bytes, static_cast<std::uint64_t>(static_cast<std::int64_t>(number)));
      break;
    case Kind::f32:
      appendF32(bytes, static_cast<float>(number));
      break;
    case Kind::f64:
      appendF64(bytes, number);
      break;
    default:
      RINGLET_ASSERT(false, "no number");
  }
}

// What the sections say, as it is put together.
class HeadMaker {
 public:
  explicit HeadMaker(const UsdStage& stage) : stage_(stage) {}

  UsdcHead make() {
    tokenOf(";-)");  // no property may have the first name: negative in PATHS, it would be a prim's
    beginFile();
    addRoot();
    for (const UsdStagePrim& prim : stage_.prims) addPrim(prim, "");
    paths_.front().end = paths_.size();
    addSections();
    align();
    for (const bool isLate : {false, true}) {
      for (UsdcSamples& samples : head_.samples) {
        if (samples.comesLater != isLate) continue;
        samples.slot = head_.frameBytes;
        head_.frameBytes += samples.byteCount();
        if (!isLate) head_.earlyBytes = head_.frameBytes;
      }
    }
    return std::move(head_);
  }

 private:
  using Fields = std::vector<std::pair<std::string_view, Rep>>;
  struct PathEntry {
    std::int32_t element;  // its name's token, negative of a property
    std::int32_t fieldSet;
    SpecType type;
    std::size_t end;  // behind the last path below it
  };

  // --- Values.

  void align() { head_.bytes.resize((head_.bytes.size() + 7) / 8 * 8); }
  // Where the next value begins.
  std::uint64_t place() {
    align();
    return head_.bytes.size();
  }
  std::int32_t tokenOf(std::string_view name) {
    const auto [found, isNew] =
        tokens_.try_emplace(std::string(name), static_cast<std::int32_t>(names_.size()));
    if (isNew) names_.push_back(found->first);
    return found->second;
  }
  Rep token(std::string_view name) {
    return Rep::inlined(kTokenType, static_cast<std::uint32_t>(tokenOf(name)));
  }
  Rep real(double value) {
    const Rep rep = Rep::at(kDoubleType, place());
    appendF64(head_.bytes, value);
    return rep;
  }
  template <class Named>
  Rep nameVector(const std::vector<Named>& named) {
    const Rep rep = Rep::at(kTokenVectorType, place());
    appendU64(head_.bytes, named.size());
    for (const Named& each : named) appendU32(head_.bytes, static_cast<std::uint32_t>(tokenOf(each.name)));
    return rep;
  }

  Rep prepended(const std::vector<std::string>& tokens) {
    const Rep rep = Rep::at(kTokenListType, place());
    head_.bytes.push_back(kPrependedItems);
    appendU64(head_.bytes, tokens.size());
    for (const std::string& each : tokens) appendU32(head_.bytes, static_cast<std::uint32_t>(tokenOf(each)));
    return rep;
  }

  Rep valueOf(const UsdStageAttribute& attribute, UsdStageType type) {
    const bool isText = type.kind() == Kind::token || type.kind() == Kind::string;
    const std::size_t count = isText ? attribute.texts.size() : attribute.numbers.size() / type.width();
    if (!type.isArray) {
      RINGLET_ASSERT(count == 1, "a value of one element");
      return isText ? textOf(type.kind(), attribute.texts.front()) : scalarOf(attribute, type);
    }
    if (count == 0) return Rep::arrayAt(type.number, 0);
    std::vector<std::uint32_t> texts;
    for (const std::string& text : attribute.texts) texts.push_back(textOf(type.kind(), text).low());
    const Rep rep = Rep::arrayAt(type.number, place());
    appendU64(head_.bytes, count);
    for (const std::uint32_t text : texts) appendU32(head_.bytes, text);
    for (const double number : attribute.numbers) appendNumber(head_.bytes, type.kind(), number);
    return rep;
  }
  Rep textOf(Kind kind, const std::string& text) {
    if (kind == Kind::token) return token(text);
    strings_.push_back(static_cast<std::uint32_t>(tokenOf(text)));
    return Rep::inlined(kStringType, static_cast<std::uint32_t>(strings_.size() - 1));
  }
  // Numbers of up to four bytes stand in the value itself.
  Rep scalarOf(const UsdStageAttribute& attribute, UsdStageType type) {
    std::vector<std::byte> bytes;
    for (const double number : attribute.numbers) appendNumber(bytes, type.kind(), number);
    if (bytes.size() > 4) {
      const Rep rep = Rep::at(type.number, place());
      head_.bytes.insert(head_.bytes.end(), bytes.begin(), bytes.end());
      return rep;
    }
    bytes.resize(4);
    return Rep::inlined(type.number, readU32(bytes, 0));
  }

  // --- What is there.

  void beginFile() {
    std::vector<std::byte>& bytes = head_.bytes;
    for (const char c : kMagic) bytes.push_back(static_cast<std::byte>(c));
    for (const unsigned part : {0u, kWrittenMinor}) bytes.push_back(static_cast<std::byte>(part));
    bytes.resize(kHeaderSize);
    if (stage_.frameCount == 0) return;
    for (const char c : kUsdcMark) bytes.push_back(static_cast<std::byte>(c));

    // The times, which all that moves shares.
    head_.timeCountAt = place();
    times_ = Rep::at(kDoubleVectorType, head_.timeCountAt);
    appendU64(bytes, static_cast<std::uint64_t>(stage_.frameCount));
    for (int i = 0; i < stage_.frameCount; ++i) appendF64(bytes, stage_.firstTimeCode + i);
  }

  std::int32_t addFields(const Fields& fields) {
    const auto first = static_cast<std::int32_t>(fieldSets_.size());
    for (const auto& [name, rep] : fields) {
      fieldSets_.push_back(static_cast<std::int32_t>(fieldNames_.size()));
      fieldNames_.push_back(tokenOf(name));
      appendU64(fieldValues_, rep.bits);
    }
    fieldSets_.push_back(static_cast<std::int32_t>(kNone));
    return first;
  }

  void addRoot() {
    Fields fields{{"defaultPrim", token(stage_.defaultPrim)}};
    if (stage_.frameCount > 0) {
      fields.push_back({"endTimeCode", real(stage_.firstTimeCode - 1)});
      head_.endTimeCodeAt = fields.back().second.payload();
    }
    fields.push_back({"metersPerUnit", real(stage_.metresPerUnit)});
    if (stage_.frameCount > 0) {
      fields.push_back({"startTimeCode", real(stage_.firstTimeCode)});
      fields.push_back({"timeCodesPerSecond", real(stage_.framesPerSecond)});
    }
    if (stage_.up) fields.push_back({"upAxis", token(*stage_.up == UpAxis::y ? "Y" : "Z")});
    fields.push_back({"primChildren", nameVector(stage_.prims)});
    addPath(tokenOf(""), fields, SpecType::root);
  }

  void addPrim(const UsdStagePrim& prim, const std::string& above) {
    const std::size_t index = paths_.size();
    const std::string path = above + "/" + prim.name;
    Fields fields{{"specifier", Rep::inlined(kSpecifierType, prim.isOver ? 1 : 0)}};
    if (!prim.type.empty()) fields.push_back({"typeName", token(prim.type)});
    if (!prim.apiSchemas.empty()) fields.push_back({"apiSchemas", prepended(prim.apiSchemas)});
    if (!prim.attributes.empty()) fields.push_back({"properties", nameVector(prim.attributes)});
    if (!prim.children.empty()) fields.push_back({"primChildren", nameVector(prim.children)});
    addPath(tokenOf(prim.name), fields, SpecType::prim);
    for (const UsdStageAttribute& attribute : prim.attributes) addAttribute(attribute, path);
    for (const UsdStagePrim& child : prim.children) addPrim(child, path);
    paths_[index].end = paths_.size();
  }

  void addAttribute(const UsdStageAttribute& attribute, const std::string& prim) {
    const auto type = usdTypeOf(attribute.type);
    RINGLET_ASSERT(type, "a type that is written");
    Fields fields{{"typeName", token(attribute.type)}};
    if (attribute.isUniform) fields.push_back({"variability", Rep::inlined(kVariabilityType, 1)});
    if (!attribute.interpolation.empty()) fields.push_back({"interpolation", token(attribute.interpolation)});
    if (attribute.elementsOfSample > 0) {
      fields.push_back({"timeSamples", addSamples(attribute, *type, prim)});
    } else {
      fields.push_back({"default", valueOf(attribute, *type)});
    }
    addPath(-tokenOf(attribute.name), fields, SpecType::attribute);
  }

  Rep addSamples(const UsdStageAttribute& attribute, UsdStageType type, const std::string& prim) {
    const Rep rep = Rep::at(kSamplesType, place());
    appendU64(head_.bytes, 8);
    appendU64(head_.bytes, times_.bits);
    appendU64(head_.bytes, 8);
    head_.samples.push_back({.path = prim + "." + attribute.name,
                             .type = type,
                             .elements = attribute.elementsOfSample,
                             .countAt = head_.bytes.size(),
                             .repsAt = head_.bytes.size() + 8,
                             .comesLater = attribute.comesLater});
    appendU64(head_.bytes, static_cast<std::uint64_t>(stage_.frameCount));
    for (int i = 0; i < stage_.frameCount; ++i) appendU64(head_.bytes, kBlock.bits);
    return rep;
  }

  // --- The sections.

  void addPath(std::int32_t element, const Fields& fields, SpecType type) {
    paths_.push_back({element, addFields(fields), type, paths_.size() + 1});
  }
  // A path's sibling follows what is below it, unless it is the last that its parent has.
  std::vector<std::int32_t> jumps() const {
    std::vector<std::int32_t> jumps;
    std::vector<std::size_t> ends;  // of those we are below
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      while (!ends.empty() && ends.back() <= i) ends.pop_back();
      const std::size_t end = paths_[i].end;
      const bool hasChild = end > i + 1, hasSibling = !ends.empty() && end < ends.back();
      jumps.push_back(hasChild && hasSibling ? static_cast<std::int32_t>(end - i)
                      : hasChild             ? kChildOnly
                      : hasSibling           ? kSiblingOnly
                                             : kLeaf);
      ends.push_back(end);
    }
    return jumps;
  }

  void appendPacked(const std::vector<std::byte>& packed) {
    appendU64(head_.bytes, packed.size());
    head_.bytes.insert(head_.bytes.end(), packed.begin(), packed.end());
  }
  void appendIntegers(const std::vector<std::int32_t>& values) { appendPacked(packUsdcIntegers(values)); }
  template <class Member>
  std::vector<std::int32_t> ofPaths(Member member) const {
    std::vector<std::int32_t> values;
    for (const PathEntry& path : paths_) values.push_back(static_cast<std::int32_t>(path.*member));
    return values;
  }
  std::vector<std::int32_t> pathIndices() const {
    std::vector<std::int32_t> indices(paths_.size());
    for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::int32_t>(i);
    return indices;
  }

  void addSections() {
    std::array<std::pair<std::uint64_t, std::uint64_t>, kSections.size()> ranges{};
    for (std::size_t i = 0; i < kSections.size(); ++i) {
      const std::uint64_t begin = place();
      (this->*kSectionWriters[i])();
      ranges[i] = {begin, head_.bytes.size() - begin};
    }
    const std::uint64_t table = place();
    appendU64(head_.bytes, kSections.size());
    for (std::size_t i = 0; i < kSections.size(); ++i) {
      std::string name(kSections[i]);
      name.resize(kNameSize);
      for (const char c : name) head_.bytes.push_back(static_cast<std::byte>(c));
      appendU64(head_.bytes, ranges[i].first);
      appendU64(head_.bytes, ranges[i].second);
    }
    std::vector<std::byte> at;
    appendU64(at, table);
    std::ranges::copy(at, head_.bytes.begin() + kTableOffset);
  }
  void appendTokens() {
    std::vector<std::byte> text;
    for (const std::string& name : names_) {
      for (const char c : name) text.push_back(static_cast<std::byte>(c));
      text.push_back(std::byte{0});
    }
    appendU64(head_.bytes, names_.size());
    appendU64(head_.bytes, text.size());
    appendPacked(packUsdc(text));
  }
  void appendStrings() {
    appendU64(head_.bytes, strings_.size());
    for (const std::uint32_t token : strings_) appendU32(head_.bytes, token);
  }
  void appendFields() {
    appendU64(head_.bytes, fieldNames_.size());
    appendIntegers(fieldNames_);
    appendPacked(packUsdc(fieldValues_));
  }
  void appendFieldSets() {
    appendU64(head_.bytes, fieldSets_.size());
    appendIntegers(fieldSets_);
  }
  void appendPaths() {
    appendU64(head_.bytes, paths_.size());
    appendU64(head_.bytes, paths_.size());
    appendIntegers(pathIndices());
    appendIntegers(ofPaths(&PathEntry::element));
    appendIntegers(jumps());
  }
  void appendSpecs() {
    appendU64(head_.bytes, paths_.size());
    appendIntegers(pathIndices());
    appendIntegers(ofPaths(&PathEntry::fieldSet));
    appendIntegers(ofPaths(&PathEntry::type));
  }
  static constexpr std::array<void (HeadMaker::*)(), kSections.size()> kSectionWriters{
      &HeadMaker::appendTokens,    &HeadMaker::appendStrings, &HeadMaker::appendFields,
      &HeadMaker::appendFieldSets, &HeadMaker::appendPaths,   &HeadMaker::appendSpecs};

  const UsdStage& stage_;
  UsdcHead head_;
  Rep times_;
  std::map<std::string, std::int32_t, std::less<>> tokens_;
  std::vector<std::string> names_;
  std::vector<std::uint32_t> strings_;
  std::vector<std::int32_t> fieldNames_, fieldSets_;
  std::vector<std::byte> fieldValues_;
  std::vector<PathEntry> paths_;  // depth first
};

}  // namespace

UsdcHead usdcHeadOf(const UsdStage& stage) { return HeadMaker(stage).make(); }

}  // namespace ringlet
