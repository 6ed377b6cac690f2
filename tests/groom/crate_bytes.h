// CrateBytes: binary USD (.usdc) piece by piece, from the format's description, for tests and for the
// fuzzers' seeds. It writes what is legal and simplest: LZ4 blocks of literals only, every integer in 32
// bits.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet::test {

class CrateBytes {
 public:
  static constexpr std::uint32_t kPrim = 6, kRoot = 7, kAttribute = 1, kRelationship = 8;
  using Rep = std::uint64_t;
  /// Of its tables: the last index into the other is one past its end.
  enum class Index { tokenOfField, fieldOfSet, setOfSpec, pathOfSpec };
  std::optional<Index> pastTheEnd{};

  using Fields = std::vector<std::pair<std::string, Rep>>;

  std::uint8_t minorVersion = 8;

  // --- Values; big ones are written at once.

  Rep token(const std::string& name) { return inlined(11, tokenIndex(name)); }
  Rep string(const std::string& text) {
    strings_.push_back(tokenIndex(text));
    return inlined(10, static_cast<std::uint32_t>(strings_.size() - 1));
  }
  Rep flag(bool value) { return inlined(1, value); }
  Rep specifier(std::uint32_t value) { return inlined(42, value); }
  Rep real(float value) { return inlined(8, std::bit_cast<std::uint32_t>(value)); }
  Rep block() { return inlined(51, 0); }
  /// A type's own inline form: bytes of small numbers, say.
  static Rep inlined(std::uint32_t type, std::uint32_t bits) { return Rep{1} << 62 | Rep{type} << 48 | bits; }
  template <class Number>
  Rep scalar(std::uint32_t type, const std::vector<Number>& numbers) {
    const Rep at = place();
    for (const Number number : numbers) append(values_, number);
    return Rep{type} << 48 | at;
  }
  template <class Number>
  Rep array(std::uint32_t type, const std::vector<Number>& numbers, std::size_t width = 1) {
    const Rep at = place();
    if (minorVersion < 5) append(values_, std::uint32_t{1});
    appendCount(numbers.size() / width);
    for (const Number number : numbers) append(values_, number);
    return Rep{1} << 63 | Rep{type} << 48 | at;
  }
  Rep points(const std::vector<Vec3f>& points) {
    std::vector<float> numbers;
    for (const Vec3f p : points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
    return array(24, numbers, 3);
  }
  Rep integers(const std::vector<std::int32_t>& numbers) { return array(3, numbers); }
  /// The same packed; `count` claims how many.
  Rep packedIntegers(const std::vector<std::int32_t>& numbers, std::size_t count) {
    const Rep at = place();
    appendCount(count);
    values_ += packedOf(codedIntegers(numbers));
    return Rep{1} << 63 | Rep{1} << 61 | Rep{3} << 48 | at;
  }
  Rep packedBytes(const std::string& packed, std::size_t count) {
    const Rep at = place();
    appendCount(count);
    append(values_, std::uint64_t{packed.size()});
    values_ += packed;
    return Rep{1} << 63 | Rep{1} << 61 | Rep{3} << 48 | at;
  }
  Rep tokens(const std::vector<std::string>& names) {
    std::vector<std::uint32_t> indices;
    for (const std::string& name : names) indices.push_back(tokenIndex(name));
    return array(11, indices);
  }
  Rep tokenVector(const std::vector<std::string>& names) {
    std::vector<std::uint32_t> indices;
    for (const std::string& name : names) indices.push_back(tokenIndex(name));
    const Rep at = place();
    append(values_, std::uint64_t{indices.size()});
    for (const std::uint32_t index : indices) append(values_, index);
    return Rep{41} << 48 | at;
  }
  /// A list edit of paths or names (types 32 to 39, 55) that is explicit and has so many items of four bytes.
  Rep listEdit(std::uint32_t type, std::size_t count) {
    const Rep at = place();
    values_ += '\3';
    append(values_, std::uint64_t{count});
    for (std::size_t i = 0; i < count; ++i) append(values_, std::uint32_t{0});
    return Rep{type} << 48 | at;
  }
  /// Assets, as a value and as an array.
  Rep asset(const std::string& path) { return inlined(12, tokenIndex(path)); }
  Rep assets(const std::vector<std::string>& paths) {
    std::vector<std::uint32_t> indices;
    for (const std::string& path : paths) indices.push_back(tokenIndex(path));
    return array(12, indices);
  }
  /// Entries of a name and a value.
  Rep dictionary(const Fields& entries) {
    for (const auto& [name, value] : entries) string(name);
    const auto first = static_cast<std::uint32_t>(strings_.size() - entries.size());
    const Rep at = place();
    append(values_, std::uint64_t{entries.size()});
    for (std::size_t k = 0; k < entries.size(); ++k) {
      append(values_, static_cast<std::uint32_t>(first + k));
      append(values_, std::uint64_t{8});
      append(values_, entries[k].second);
    }
    return Rep{31} << 48 | at;
  }
  /// A list of names that is explicit, or that puts some before others (bit 32), deletes some (8) ...
  Rep stringList(const std::vector<std::string>& names, char bits = '\3') {
    for (const std::string& name : names) string(name);
    const auto first = static_cast<std::uint32_t>(strings_.size() - names.size());
    const Rep at = place();
    values_ += bits;
    append(values_, std::uint64_t{names.size()});
    for (std::size_t k = 0; k < names.size(); ++k) append(values_, static_cast<std::uint32_t>(first + k));
    return Rep{33} << 48 | at;
  }
  /// A list of paths that are there already, explicit or one that is put before others.
  Rep pathList(const std::vector<std::string>& paths, bool isPrepended = false) {
    const Rep at = place();
    values_ += isPrepended ? '\40' : '\3';
    append(values_, std::uint64_t{paths.size()});
    for (const std::string& path : paths) {
      const auto found = std::ranges::find(specs_, path, &Spec::path);
      append(values_, static_cast<std::uint32_t>(found - specs_.begin()));
    }
    return Rep{34} << 48 | at;
  }
  Rep samples(const std::vector<double>& times, const std::vector<Rep>& values) {
    const Rep list = place();
    append(values_, std::uint64_t{times.size()});
    for (const double time : times) append(values_, time);
    const Rep at = place();
    append(values_, std::uint64_t{8});
    append(values_, Rep{48} << 48 | list);
    append(values_, std::uint64_t{8});
    append(values_, std::uint64_t{values.size()});
    for (const Rep value : values) append(values_, value);
    return Rep{46} << 48 | at;
  }

  // --- What is at a path: "/", "/A/B", "/A/B.points". Parents come before what is below them.

  void add(const std::string& path, std::uint32_t type, const Fields& fields) {
    Spec spec{path, type, {}};
    for (const auto& [name, rep] : fields) spec.fields.push_back({tokenIndex(name), rep});
    specs_.push_back(std::move(spec));
  }
  void addRoot(const std::vector<std::string>& children, Fields fields = {}) {
    fields.push_back({"primChildren", tokenVector(children)});
    add("/", kRoot, fields);
  }
  void addPrim(const std::string& path, const std::string& type,
               const std::vector<std::string>& children = {}, Fields fields = {}) {
    fields.push_back({"specifier", specifier(0)});
    if (!type.empty()) fields.push_back({"typeName", token(type)});
    if (!children.empty()) fields.push_back({"primChildren", tokenVector(children)});
    add(path, kPrim, fields);
  }
  void addAttribute(const std::string& path, Rep value) { add(path, kAttribute, {{"default", value}}); }

  /// A file with two linear strands below a moved prim, in metres, Z up.
  static CrateBytes small();

  std::string bytes() const {
    std::string text;
    for (const std::string& name : tokens_) text += name + '\0';
    std::string sections[6];
    append(sections[0], std::uint64_t{tokens_.size()});
    append(sections[0], std::uint64_t{text.size()});
    sections[0] += packedOf(text);
    append(sections[1], std::uint64_t{strings_.size()});
    for (const std::uint32_t index : strings_) append(sections[1], index);

    // Fields and their sets, one a spec.
    std::vector<std::int32_t> names, sets, setOf;
    std::string reps;
    for (const Spec& spec : specs_) {
      setOf.push_back(static_cast<std::int32_t>(sets.size()));
      for (const auto& [name, rep] : spec.fields) {
        sets.push_back(static_cast<std::int32_t>(names.size()));
        names.push_back(static_cast<std::int32_t>(name));
        append(reps, rep);
      }
      sets.push_back(-1);
    }
    const auto lastMayBeWrong = [&](Index table, std::vector<std::int32_t>& indices, std::size_t count) {
      if (pastTheEnd != table) return;
      const auto last = std::find_if(indices.rbegin(), indices.rend(), [](std::int32_t i) { return i >= 0; });
      *last = static_cast<std::int32_t>(count);
    };
    lastMayBeWrong(Index::tokenOfField, names, tokens_.size());
    lastMayBeWrong(Index::fieldOfSet, sets, names.size());
    lastMayBeWrong(Index::setOfSpec, setOf, sets.size());
    append(sections[2], std::uint64_t{names.size()});
    sections[2] += packedOf(codedIntegers(names)) + packedOf(reps);
    append(sections[3], std::uint64_t{sets.size()});
    sections[3] += packedOf(codedIntegers(sets));
    sections[4] = pathSection();
    append(sections[5], std::uint64_t{specs_.size()});
    std::vector<std::int32_t> paths, types;
    for (std::size_t i = 0; i < specs_.size(); ++i) {
      paths.push_back(static_cast<std::int32_t>(i));
      types.push_back(static_cast<std::int32_t>(specs_[i].type));
    }
    lastMayBeWrong(Index::pathOfSpec, paths, specs_.size());
    for (const auto& list : {paths, setOf, types}) sections[5] += packedOf(codedIntegers(list));

    // All of it, and where it is.
    std::string out = "PXR-USDC";
    out += std::string{'\0', static_cast<char>(minorVersion), '\0', '\0', '\0', '\0', '\0', '\0'};
    out.resize(kHeaderSize, '\0');
    out += values_;
    std::string table;
    append(table, std::uint64_t{6});
    const char* sectionNames[] = {"TOKENS", "STRINGS", "FIELDS", "FIELDSETS", "PATHS", "SPECS"};
    for (std::size_t i = 0; i < 6; ++i) {
      std::string name = sectionNames[i];
      name.resize(16, '\0');
      table += name;
      append(table, std::uint64_t{out.size()});
      append(table, std::uint64_t{sections[i].size()});
      out += sections[i];
    }
    const std::uint64_t at = out.size();
    std::memcpy(out.data() + 16, &at, 8);
    return out + table;
  }

  // --- Its coding.

  /// An LZ4 block of literals.
  static std::string literals(const std::string& bytes) {
    std::string block(1, static_cast<char>(std::min<std::size_t>(bytes.size(), 15) << 4));
    if (bytes.size() >= 15) {
      std::size_t rest = bytes.size() - 15;
      for (; rest >= 255; rest -= 255) block += '\xff';
      block += static_cast<char>(rest);
    }
    return block + bytes;
  }
  static std::string packedOf(const std::string& bytes) {
    if (bytes.empty()) return std::string(8, '\0');
    const std::string packed = '\0' + literals(bytes);
    std::string out;
    append(out, std::uint64_t{packed.size()});
    return out + packed;
  }
  /// Every difference in 32 bits.
  static std::string codedIntegers(const std::vector<std::int32_t>& numbers) {
    if (numbers.empty()) return "";
    std::string out(4, '\0'), data;
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (i % 4 == 0) out += '\0';
      out.back() = static_cast<char>(out.back() | 3 << 2 * (i % 4));
      append(data, static_cast<std::uint32_t>(numbers[i]) - before);
      before = static_cast<std::uint32_t>(numbers[i]);
    }
    return out + data;
  }
  template <class Value>
  static void append(std::string& out, const Value& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

 private:
  static constexpr std::size_t kHeaderSize = 88;
  struct Spec {
    std::string path;
    std::uint32_t type;
    std::vector<std::pair<std::uint32_t, Rep>> fields;
  };

  std::uint32_t tokenIndex(const std::string& name) {
    const auto [found, isNew] = tokenIndices_.insert({name, static_cast<std::uint32_t>(tokens_.size())});
    if (isNew) tokens_.push_back(name);
    return found->second;
  }
  // Where the next value begins: from the file's first byte.
  Rep place() {
    values_.resize((values_.size() + 7) / 8 * 8, '\0');
    return kHeaderSize + values_.size();
  }
  void appendCount(std::size_t count) {
    if (minorVersion < 7) {
      append(values_, static_cast<std::uint32_t>(count));
    } else {
      append(values_, std::uint64_t{count});
    }
  }

  // The tree, depth first: what stands below each spec, in their order.
  std::string pathSection() const {
    std::vector<std::int32_t> indices, names, jumps;
    visit(0, false, indices, names, jumps);
    std::string out;
    append(out, std::uint64_t{specs_.size()});
    append(out, std::uint64_t{indices.size()});
    for (const auto& list : {indices, names, jumps}) out += packedOf(codedIntegers(list));
    return out;
  }
  static std::pair<std::string, std::string> split(const std::string& path) {
    const std::size_t end = path.find('.') == std::string::npos ? path.rfind('/') : path.find('.');
    return {end == 0 ? "/" : path.substr(0, end), path.substr(end + 1)};
  }
  void visit(std::size_t index, bool hasSibling, std::vector<std::int32_t>& indices,
             std::vector<std::int32_t>& names, std::vector<std::int32_t>& jumps) const {
    const std::string& path = specs_[index].path;
    const bool isProperty = path.find('.') != std::string::npos;
    const std::string name = path == "/" ? ";-)" : split(path).second;
    const auto token = static_cast<std::int32_t>(tokenIndices_.at(name));
    std::vector<std::size_t> children;
    for (std::size_t i = 1; i < specs_.size(); ++i) {
      if (split(specs_[i].path).first == path) children.push_back(i);
    }
    const std::size_t at = jumps.size();
    indices.push_back(static_cast<std::int32_t>(index));
    names.push_back(isProperty ? -token : token);
    jumps.push_back(0);
    for (std::size_t i = 0; i < children.size(); ++i)
      visit(children[i], i + 1 < children.size(), indices, names, jumps);
    const auto size = static_cast<std::int32_t>(jumps.size() - at);
    jumps[at] = children.empty() ? (hasSibling ? 0 : -2) : (hasSibling ? size : -1);
  }

  // The first token can name no property.
  std::vector<std::string> tokens_{";-)"};
  std::map<std::string, std::uint32_t> tokenIndices_{{";-)", 0}};
  std::vector<std::uint32_t> strings_;
  std::string values_;
  std::vector<Spec> specs_;

 public:
  /// A name that is only in a path.
  void name(const std::string& text) { tokenIndex(text); }
};

inline CrateBytes CrateBytes::small() {
  CrateBytes crate;
  for (const char* name :
       {"points", "curveVertexCounts", "type", "xformOp:translate", "xformOpOrder", "Head", "Hair"})
    crate.name(name);
  crate.addRoot({"Head"}, {{"upAxis", crate.token("Z")}, {"metersPerUnit", crate.real(1)}});
  crate.addPrim("/Head", "Xform", {"Hair"});
  crate.addAttribute("/Head.xformOpOrder", crate.tokens({"xformOp:translate"}));
  crate.addAttribute("/Head.xformOp:translate", crate.scalar<double>(23, {1, 2, 3}));
  crate.addPrim("/Head/Hair", "BasisCurves");
  crate.addAttribute("/Head/Hair.type", crate.token("linear"));
  crate.addAttribute("/Head/Hair.points",
                     crate.points({{0, 0, 0}, {0, 0, -1}, {0, 0, -2}, {1, 0, 0}, {1, 0.5f, -1}}));
  crate.addAttribute("/Head/Hair.curveVertexCounts", crate.integers({3, 2}));
  return crate;
}

}  // namespace ringlet::test
