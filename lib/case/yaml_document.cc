#include "case/yaml_document.hh"

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "base/error.hh"

namespace lgiw {
namespace {

constexpr std::size_t max_text = 1 << 20;  // bytes
constexpr std::size_t max_points = 10000;  // a longer outline belongs into a vector file

[[noreturn]] void refuse(const std::string& place, const std::string& problem, const std::string& why,
                         const std::string& suggestion) {
  throw InputError(place + ": " + problem, why, suggestion);
}

std::string line_place(const std::string& name, const YAML::Mark& mark) {
  return name + ":" + std::to_string(mark.line + 1);
}

/// `text` as it may stand in a one-line message.
std::string shown(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
  return text.size() > 60 ? text.substr(0, 57) + "..." : text;
}

std::string kind_of(const YAML::Node& node) {
  if (node.IsMap()) return "a mapping of keys";
  if (node.IsSequence()) return "a list";
  if (node.IsNull()) return "empty";
  return "\"" + shown(node.Scalar()) + "\"";
}

/// Refuses a second document, and aliases: a case is read literally, and a few nested aliases can stand for terabytes.
class LiteralCheck : public YAML::EventHandler {
 public:
  explicit LiteralCheck(std::string name) : name_(std::move(name)) {}
  void OnDocumentStart(const YAML::Mark& mark) override {
    // yaml-cpp 0.7 finds documents without end before a stray comma or bracket.
    if (document_ && document_->pos == mark.pos)
      refuse(line_place(name_, mark), "not valid YAML", "no value begins like this", "check commas and brackets here");
    if (document_)
      refuse(line_place(name_, mark), "a second YAML document begins", "a file holds one case",
             "move it to a file of its own");
    document_ = mark;
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { check(mark, anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { check(mark, 1); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor, const std::string&) override {
    check(mark, anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    check(mark, anchor);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    check(mark, anchor);
  }
  void OnMapEnd() override {}

 private:
  void check(const YAML::Mark& mark, YAML::anchor_t anchor) const {
    if (anchor != 0)
      refuse(line_place(name_, mark), "a YAML anchor or alias", "a case is read literally", "write the value out");
  }
  std::string name_;
  std::optional<YAML::Mark> document_;
};

std::vector<std::string> components(const std::string& key) {
  std::vector<std::string> parts(1);
  for (const char c : key) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

bool is_at_or_below(const std::string& key, const std::string& parent) {
  return key == parent ||
         (key.size() > parent.size() && key[parent.size()] == '.' && key.compare(0, parent.size(), parent) == 0);
}

/// The number that `text` is, nothing else in it. Fails for NaN, infinity and what a double cannot hold.
std::optional<double> parse_number(const std::string& text) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Why `text` is no number, and what to write: "10 m" and "1,5" are the usual ones.
std::pair<std::string, std::string> number_mistake(const std::string& text) {
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const char* word : {"nan", ".nan", "inf", ".inf", "-inf", "-.inf", "+.inf", "infinity"})
    if (lower == word) return {"a finite number is wanted", "write its value"};
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) return {"no finite number is that large or small", "check the exponent"};
  if (error == std::errc()) {
    std::string number(text.data(), stop), rest(stop, text.data() + text.size());
    if (rest.size() > 1 && rest[0] == ',' && std::isdigit(static_cast<unsigned char>(rest[1])))
      return {"a decimal comma is no number", "write " + number + "." + rest.substr(1)};
    return {"a number is wanted, without a unit", "write " + number};
  }
  return {"a number is wanted", "write a number"};
}

}  // namespace

YAML::Node parse_yaml(const std::string& text, const std::string& name) {
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    LiteralCheck check(name);
    while (parser.HandleNextDocument(check)) {
    }
    return YAML::Load(text);
  } catch (const YAML::DeepRecursion& e) {
    refuse(line_place(name, e.mark), "not a case", "it nests hundreds of levels deep",
           "check brackets and indentation");
  } catch (const YAML::Exception& e) {
    refuse(line_place(name, e.mark), "not valid YAML", shown(e.msg), "check indentation, brackets and quotes here");
  }
}

Override override_of_option(const std::string& text) { return {text, "--set " + shown(text)}; }

bool Quantity::admits(double value) const {
  if (value == 0 && (or_zero || automatic)) return true;
  return (above_low ? value > low : value >= low) && (below_high ? value < high : value <= high);
}

std::string Quantity::range() const {
  std::string text;
  if (automatic) text += "auto or ";
  if (or_zero) text += "0 or ";
  const std::string of_unit = unit.empty() ? "" : " " + unit;
  if (std::isfinite(low)) text += (above_low ? "above " : "at least ") + number_text(low);
  if (std::isfinite(low) && std::isfinite(high)) text += " and ";
  if (std::isfinite(high)) text += (below_high ? "below " : "at most ") + number_text(high);
  return "it must be " + text + of_unit;
}

YamlDocument::YamlDocument(const std::string& text, const std::string& name, const std::vector<Override>& overrides)
    : name_(name) {
  if (text.size() > max_text)
    refuse(name + ":1", "more than 1 MiB of text", "a case is a page or two", "put outlines into a vector file");
  const auto odd = std::find_if(text.begin(), text.end(), [](unsigned char c) {
    return (c < ' ' && c != '\n' && c != '\r' && c != '\t') || c == 127;
  });
  if (odd != text.end())
    refuse(name + ":" + std::to_string(1 + std::count(text.begin(), odd, '\n')), "not a text file",
           "it holds control characters", "give a case file in YAML");
  root_ = parse_yaml(text, name);
  if (root_.IsNull() && overrides.empty())
    refuse(name + ":1", "the case is empty", "no key is in it", "start from docs/case-reference.yaml");
  if (!root_.IsMap() && !root_.IsNull())
    refuse(line_place(name, root_.Mark()), "not a case", "it is " + kind_of(root_) + " where keys are wanted",
           "start from docs/case-reference.yaml");
  for (const Override& given : overrides) apply(given);
  places_[""] = name + ":1";
}

void YamlDocument::apply(const Override& given) {
  const std::string &override_text = given.text, &place = given.place;
  const std::size_t equals = override_text.find('=');
  if (equals == std::string::npos || equals == 0)
    refuse(place, "not an override", "key and value are joined by =", "write --set key.sub=value");
  if (override_text.size() > max_text)
    refuse(place, "more than 1 MiB of text", "an override is one value", "write it into the case file");
  const bool append = override_text[equals - 1] == '+';
  const std::string key = override_text.substr(0, append ? equals - 1 : equals);
  YAML::Node value = parse_yaml(override_text.substr(equals + 1), place);
  std::string overridden = key;
  const auto add_to = [&](YAML::Node list) {
    if (list.IsDefined() && !list.IsSequence() && !list.IsNull())
      refuse(place, key + " is " + kind_of(list), "items are added to a list", "write " + key + "=VALUE");
    list.push_back(value);
    overridden += "." + std::to_string(list.size() - 1);
  };
  const std::vector<std::string> parts = components(key);
  YAML::Node node = root_;
  std::string reached;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool last = i + 1 == parts.size();
    if (parts[i].empty()) refuse(place, "not an override", "a part of the key is empty", "write --set key.sub=value");
    YAML::Node child;
    if (node.IsSequence()) {
      std::size_t index = 0;
      const auto [stop, error] = std::from_chars(parts[i].data(), parts[i].data() + parts[i].size(), index);
      if (error != std::errc() || *stop != 0 || index >= node.size())
        refuse(place, "there is no item " + parts[i] + " in " + reached,
               "it is a list of " + std::to_string(node.size()), "count from 0");
      if (last && append)
        add_to(node[index]);
      else if (last && value.IsNull())
        node.remove(index);
      else if (last)
        node[index] = value;
      else
        child.reset(node[index]);
    } else {
      if (!node.IsMap() && !node.IsNull())
        refuse(place, reached + " has no keys", "it is " + kind_of(node), "name a key that exists");
      if (last && append)
        add_to(node[parts[i]]);
      else if (last && value.IsNull())
        node.remove(parts[i]);
      else if (last)
        node[parts[i]] = value;
      else {
        if (!node[parts[i]].IsDefined()) node[parts[i]] = YAML::Node(YAML::NodeType::Map);
        child.reset(node[parts[i]]);
      }
    }
    if (!last) node.reset(child);
    reached += (i ? "." : "") + parts[i];
  }
  overrides_.emplace_back(overridden, place);
}

const std::string* YamlDocument::override_of(const std::string& key) const {
  for (auto it = overrides_.rbegin(); it != overrides_.rend(); ++it)
    if (is_at_or_below(key, it->first)) return &it->second;
  return nullptr;
}

std::string YamlDocument::place(const std::string& key, const YAML::Node& node) const {
  if (const std::string* found = override_of(key)) return *found;
  return node.Mark().is_null() ? place(key) : line_place(name_, node.Mark());
}

void YamlDocument::check_keys(const std::set<std::string>& known) { check_keys(root_, "", "", known); }

void YamlDocument::check_keys(const YAML::Node& node, const std::string& key, const std::string& known_key,
                              const std::set<std::string>& known) {
  if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      const std::string item = key + "." + std::to_string(i);
      places_[item] = place(item, node[i]);
      if (node[i].IsMap()) check_keys(node[i], item, known_key, known);
    }
    return;
  }
  if (!node.IsMap()) return;
  const std::string prefix = known_key.empty() ? "" : known_key + ".";
  std::vector<std::string> siblings;
  for (const std::string& k : known)
    if (k.compare(0, prefix.size(), prefix) == 0 && k.find('.', prefix.size()) == std::string::npos)
      siblings.push_back(k.substr(prefix.size()));
  if (siblings.empty()) return;  // a mapping where a value belongs: reading it tells so
  std::set<std::string> seen;
  for (const auto& entry : node) {
    const std::string section = key.empty() ? "a case" : key;
    if (!entry.first.IsScalar())
      refuse(place(key, entry.first), "a key of " + section + " is no word", "keys are plain words",
             "write key: value");
    const std::string word = entry.first.Scalar();
    const std::string path = key.empty() ? word : key + "." + word;
    std::string where = place(path, entry.first);
    // A parent that only an override brought has no line of its own.
    if (entry.first.Mark().is_null() || entry.first.Mark().pos < 0)
      for (const auto& [overridden, text] : overrides_)
        if (is_at_or_below(overridden, path)) where = text;
    if (std::find(siblings.begin(), siblings.end(), word) == siblings.end()) {
      const auto elsewhere = std::find_if(known.begin(), known.end(), [&word](const std::string& k) {
        return k.substr(k.rfind('.') + 1) == word;  // npos + 1 is 0
      });
      const std::string nearest = nearest_word(word, siblings);
      refuse(where, "unknown key \"" + shown(word) + "\"", section + " has no such key",
             elsewhere != known.end() ? "it is known as " + *elsewhere : "did you mean \"" + nearest + "\"?");
    }
    if (!seen.insert(word).second)
      refuse(where, path + " is given twice", "the first is at " + places_[path], "leave one of them out");
    places_[path] = where;
    if (entry.second.IsNull())
      refuse(where, path + " has no value", "a key without one means nothing", "give it one or leave the key out");
    check_keys(entry.second, path, prefix + word, known);
  }
}

YamlSection::YamlSection(YamlDocument& document) : YamlSection(document, "", "", document.root()) {}

YamlSection::YamlSection(YamlDocument& document, std::string path, std::string known_path, YAML::Node node)
    : document_(&document), path_(std::move(path)), known_path_(std::move(known_path)), node_(std::move(node)) {}

YAML::Node YamlSection::get(const std::string& key) const {
  document_->asked.insert(known_path_.empty() ? key : known_path_ + "." + key);
  if (!node_.IsDefined() || !node_.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
  const YAML::Node& map = node_;  // only the const operator leaves a missing key missing
  return map[key];
}

bool YamlSection::has(const std::string& key) const { return get(key).IsDefined(); }

void YamlSection::require(const std::string& key, const std::string& why, const std::string& suggestion) const {
  if (present() && !has(key)) refuse(document_->place(path_), path(key) + " is missing", why, suggestion);
}

double YamlSection::parse(const std::string& key, const YAML::Node& node, const Quantity& quantity,
                          std::optional<double> fallback) const {
  const std::string place = document_->place(path(key), node);
  if (!node.IsScalar())
    refuse(place, path(key) + " is " + kind_of(node), "a number is wanted",
           "write one number" + (quantity.unit.empty() ? "" : " in " + quantity.unit));
  const std::string text = node.Scalar();
  if (quantity.automatic && text == "auto") return 0;
  const std::optional<double> value = parse_number(text);
  if (!value) {
    const auto [why, suggestion] = number_mistake(text);
    refuse(place, path(key) + " is \"" + shown(text) + "\"", why, suggestion);
  }
  if (quantity.admits(*value)) return *value;
  std::string why = quantity.range(), suggestion = "give a value in that range";
  if (quantity.automatic)
    suggestion = "leave it out for the automatic value";
  else if (fallback && quantity.admits(*fallback))
    suggestion = "the default is " + number_text(*fallback);
  for (const UnitMistake& mistake : quantity.mistakes)
    if (*value >= mistake.low && *value <= mistake.high) {
      why += "; " + shown(text) + " looks like " + mistake.unit;
      suggestion = "write " + number_text(*value * mistake.factor) + " if it is";
      break;
    }
  refuse(place, path(key) + " is " + shown(text), why, suggestion);
}

void YamlSection::number(const std::string& key, double& target, const Quantity& quantity) const {
  if (const YAML::Node node = get(key); node.IsDefined()) target = parse(key, node, quantity, target);
}

void YamlSection::number(const std::string& key, std::optional<double>& target, const Quantity& quantity) const {
  if (const YAML::Node node = get(key); node.IsDefined()) target = parse(key, node, quantity, target);
}

void YamlSection::integer(const std::string& key, int& target, const Quantity& quantity) const {
  const YAML::Node node = get(key);
  if (!node.IsDefined()) return;
  const double value = parse(key, node, quantity, target);
  if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
    refuse(document_->place(path(key), node), path(key) + " is " + shown(node.Scalar()), "a whole number is wanted",
           "write " + number_text(std::round(value)));
  target = static_cast<int>(value);
}

const YAML::Node& YamlSection::expect_list(const std::string& key, const YAML::Node& node,
                                           const std::string& form) const {
  if (!node.IsSequence())
    refuse(document_->place(path(key), node), path(key) + " is " + kind_of(node), "a list is wanted", "write " + form);
  return node;
}

void YamlSection::numbers(const std::string& key, double* target, const std::vector<Quantity>& quantities,
                          const std::string& form) const {
  const YAML::Node node = get(key);
  if (!node.IsDefined()) return;
  if (expect_list(key, node, form).size() != quantities.size())
    refuse(document_->place(path(key), node), path(key) + " has " + std::to_string(node.size()) + " numbers",
           std::to_string(quantities.size()) + " are wanted", "write " + form);
  for (std::size_t i = 0; i < quantities.size(); ++i) target[i] = parse(key, node[i], quantities[i], std::nullopt);
}

void YamlSection::flag(const std::string& key, bool& target) const {
  const YAML::Node node = get(key);
  if (!node.IsDefined()) return;
  if (!node.IsScalar() || !YAML::convert<bool>::decode(node, target))
    refuse(document_->place(path(key), node), path(key) + " is " + kind_of(node), "it is either true or false",
           target ? "the default is true" : "the default is false");
}

void YamlSection::text(const std::string& key, std::string& target) const {
  const YAML::Node node = get(key);
  if (!node.IsDefined()) return;
  const std::string place = document_->place(path(key), node);
  if (!node.IsScalar())
    refuse(place, path(key) + " is " + kind_of(node), "a text is wanted", "write one word or quote it");
  if (node.Scalar().empty()) refuse(place, path(key) + " is empty", "an empty text means nothing", "leave the key out");
  target = node.Scalar();
}

Point2 YamlSection::parse_point(const std::string& key, const YAML::Node& node, const std::string& form) const {
  const bool pair = node.IsSequence() && node.size() == 2;
  if (!pair)
    refuse(document_->place(path(key), node),
           "a point of " + path(key) + " is " +
               (node.IsSequence() ? "a list of " + std::to_string(node.size()) : kind_of(node)),
           "a point is two numbers", "write " + form);
  return {parse(key, node[0], {}, std::nullopt), parse(key, node[1], {}, std::nullopt)};
}

std::vector<Point2> YamlSection::parse_points(const std::string& key, const YAML::Node& node,
                                              const std::string& form) const {
  if (expect_list(key, node, "[" + form + ", ...]").size() > max_points)
    refuse(document_->place(path(key), node), path(key) + " has " + std::to_string(node.size()) + " points",
           "at most " + std::to_string(max_points) + " are read from a case", "put the outline into a vector file");
  std::vector<Point2> points;
  for (const YAML::Node& point : node) points.push_back(parse_point(key, point, form));
  return points;
}

void YamlSection::points(const std::string& key, std::vector<Point2>& target, const std::string& form) const {
  if (const YAML::Node node = get(key); node.IsDefined()) target = parse_points(key, node, form);
}

void YamlSection::point_lists(const std::string& key, std::vector<std::vector<Point2>>& target,
                              const std::string& form) const {
  const YAML::Node node = get(key);
  if (!node.IsDefined()) return;
  for (const YAML::Node& list : expect_list(key, node, "[[" + form + ", ...], ...]"))
    target.push_back(parse_points(key, list, form));
}

std::optional<std::size_t> YamlSection::chosen(const std::string& key, const std::vector<std::string>& words) const {
  const YAML::Node node = get(key);
  if (!node.IsDefined()) return std::nullopt;
  const std::string word = node.IsScalar() ? node.Scalar() : "";
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return found - words.begin();
  std::string all;
  for (const std::string& w : words) all += (all.empty() ? "" : w == words.back() ? " or " : ", ") + w;
  refuse(document_->place(path(key), node), path(key) + " is " + kind_of(node), "it is one of " + all,
         node.IsScalar() ? "did you mean \"" + nearest_word(word, words) + "\"?" : "write one of them");
}

YamlSection YamlSection::section(const std::string& key) const {
  YAML::Node node = get(key);
  if (node.IsDefined() && !node.IsMap())
    refuse(document_->place(path(key)), path(key) + " is " + kind_of(node), "it is a section with keys of its own",
           "write its keys below it, indented");
  return YamlSection(*document_, path(key), known_path_.empty() ? key : known_path_ + "." + key, node);
}

std::vector<YamlSection> YamlSection::items(const std::string& key) const {
  const YAML::Node node = get(key);
  const std::string known = known_path_.empty() ? key : known_path_ + "." + key;
  if (!node.IsDefined()) return {YamlSection(*document_, path(key), known, node)};
  std::vector<YamlSection> found;
  std::size_t i = 0;
  for (const YAML::Node& item : expect_list(key, node, "a list of items, each beginning with -")) {
    const std::string item_path = path(key) + "." + std::to_string(i++);
    if (!item.IsMap())
      refuse(document_->place(item_path, item), item_path + " is " + kind_of(item), "each item is a mapping of keys",
             "write {key: value, ...}");
    found.push_back(YamlSection(*document_, item_path, known, item));
  }
  return found;
}

}  // namespace lgiw
