// A YAML document that knows where each of its keys stands, and typed reading of it. Every refusal is an InputError
// with the place (`file:line`, or the --set that brought the value) in front.
#pragma once

#include <yaml-cpp/yaml.h>

#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "case/case.hh"
#include "case/dotted_key.hh"

namespace lgiw {

/// A value from `low` to `high` (SI) that was most likely written in another unit; `factor` converts it.
struct UnitMistake {
  double low, high;
  const char* unit;
  double factor;
};

/// A key's value from outside of the document: `key.sub=value`, or `key.sub+=item` for one more item of a list.
struct Override {
  std::string text, place;  // errors name the place
};
Override override_of_option(const std::string& text);  // its place is `--set text`

/// One document of literal YAML, null for an empty text; errors name `name:line`.
YAML::Node parse_yaml(const std::string& text, const std::string& name);

/// The values that a key admits.
struct Quantity {
  std::string unit = {};
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool above_low = false, below_high = false;  // the bound itself is not admitted
  bool or_zero = false;                        // 0 is admitted besides
  bool automatic = false;                      // the same, and `auto` is another way to write it
  std::vector<UnitMistake> mistakes = {};

  bool admits(double value) const;
  std::string range() const;  // "it must be at least 300 and at most 5000 kg/m3"
};

class YamlDocument {
 public:
  YamlDocument() = default;
  /// Parses `text` and applies `overrides`. Refuses what is not one YAML mapping: syntax errors, anchors and aliases,
  /// several documents, binary files, more than 1 MiB.
  YamlDocument(const std::string& text, const std::string& name, const std::vector<Override>& overrides);

  const YAML::Node& root() const { return root_; }
  /// Dotted key (list items by number from 0) -> "file:line" or "--set key=value".
  const std::map<std::string, std::string>& places() const { return places_; }
  /// Of `key`, or of the nearest of its parents that stands in the document.
  std::string place(const std::string& key) const { return nearest_place(places_, key); }
  /// Of `node`, which stands at or below `key`.
  std::string place(const std::string& key, const YAML::Node& node) const;
  /// Refuses keys that are not in `known` (dotted, without list numbers), keys written twice, and sections that are
  /// none; notes the places of the others.
  void check_keys(const std::set<std::string>& known);

  std::set<std::string> asked;  // dotted keys that a YamlSection was asked for, without list numbers

 private:
  void apply(const Override& override);
  void check_keys(const YAML::Node& node, const std::string& key, const std::string& known_key,
                  const std::set<std::string>& known);
  const std::string* override_of(const std::string& key) const;

  YAML::Node root_{YAML::NodeType::Undefined};
  std::string name_;
  std::vector<std::pair<std::string, std::string>> overrides_;  // (dotted key, place)
  std::map<std::string, std::string> places_;
};

/// A mapping in a document; absent where the document has none. Reading a key that is absent leaves the target as it
/// is, so that a reader runs through all keys whatever the document holds.
class YamlSection {
 public:
  explicit YamlSection(YamlDocument& document);

  bool present() const { return node_.IsDefined(); }
  bool has(const std::string& key) const;
  const std::string& path() const { return path_; }
  std::string path(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  /// Refuses a section that is present but lacks `key`.
  void require(const std::string& key, const std::string& why, const std::string& suggestion) const;

  void number(const std::string& key, double& target, const Quantity& quantity) const;
  void number(const std::string& key, std::optional<double>& target, const Quantity& quantity) const;
  void integer(const std::string& key, int& target, const Quantity& quantity) const;
  /// A list of as many numbers as `quantities`, named by `form` in refusals, such as "[x, y]".
  void numbers(const std::string& key, double* target, const std::vector<Quantity>& quantities,
               const std::string& form) const;
  void flag(const std::string& key, bool& target) const;
  void text(const std::string& key, std::string& target) const;
  void points(const std::string& key, std::vector<Point2>& target, const std::string& form) const;
  void point_lists(const std::string& key, std::vector<std::vector<Point2>>& target, const std::string& form) const;

  template <class T>
  void choice(const std::string& key, T& target, const std::vector<std::pair<std::string, T>>& choices) const {
    std::vector<std::string> words;
    for (const auto& [word, value] : choices) words.push_back(word);
    if (const auto index = chosen(key, words)) target = choices[*index].second;
  }

  YamlSection section(const std::string& key) const;
  /// Reads the items of a list of mappings; without any, `read` is shown an absent section once, so that its keys are
  /// asked.
  template <class T, class Read>
  void list(const std::string& key, std::vector<T>& target, Read read) const {
    for (const YamlSection& item : items(key)) {
      T value;
      read(item, value);
      if (item.present()) target.push_back(std::move(value));
    }
  }

 private:
  YamlSection(YamlDocument& document, std::string path, std::string known_path, YAML::Node node);
  YAML::Node get(const std::string& key) const;
  std::vector<YamlSection> items(const std::string& key) const;
  std::optional<std::size_t> chosen(const std::string& key, const std::vector<std::string>& words) const;
  double parse(const std::string& key, const YAML::Node& node, const Quantity& quantity,
               std::optional<double> fallback) const;
  Point2 parse_point(const std::string& key, const YAML::Node& node, const std::string& form) const;
  std::vector<Point2> parse_points(const std::string& key, const YAML::Node& node, const std::string& form) const;
  const YAML::Node& expect_list(const std::string& key, const YAML::Node& node, const std::string& form) const;

  YamlDocument* document_;
  std::string path_, known_path_;  // with and without list numbers
  YAML::Node node_;
};

}  // namespace lgiw
