#include "case/sweep.hh"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <map>
#include <set>

#include "base/error.hh"
#include "case/case.hh"
#include "case/overridden_case.hh"
#include "case/yaml_document.hh"

namespace lgiw {
namespace {

constexpr std::size_t max_runs = 1000;
constexpr std::size_t max_name = 200;  // bytes; a folder's name has 255 at most

/// A key's value in some runs.
struct Setting {
  std::string key;
  YAML::Node value;
  std::string place;       // "sweep.yaml:3"
  std::size_t number = 0;  // of the value in its list, from 1; 0: not from a list
};

/// What one run sets besides what all of them do; its name where it has one.
struct Choice {
  std::string name;
  std::vector<Setting> settings;
};

/// On one line.
std::string one_line(const YAML::Node& node) {
  YAML::Emitter out;
  out.SetSeqFormat(YAML::Flow);
  out.SetMapFormat(YAML::Flow);
  out << node;
  std::string text = out.c_str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// The last word of a dotted key, with the words before it where that is a list's number or `keys` has it elsewhere.
std::string short_key(const std::string& key, const std::vector<std::string>& keys) {
  const auto last = [](const std::string& k) { return k.substr(k.rfind('.') + 1); };  // npos + 1 is 0
  const auto same = std::count_if(keys.begin(), keys.end(), [&](const auto& k) { return last(k) == last(key); });
  return same > 1 || key.find_first_of("0123456789") != std::string::npos ? key : last(key);
}

/// A value as a part of a folder's name. What is no plain word goes by its number in the list.
std::string short_value(const Setting& setting) {
  if (setting.value.IsNull()) return "none";
  if (!setting.value.IsScalar()) return std::to_string(std::max<std::size_t>(setting.number, 1));
  std::string text = setting.value.Scalar();
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return !std::isalnum(c) && !std::strchr("._+-", c); }, '-');
  return text;
}

class SweepReader {
 public:
  SweepReader(const std::string& name, const YAML::Node& root) : name_(name) {
    if (root.IsNull())
      throw InputError(name_ + ":1: the sweep is empty", "it names keys of the case and lists of their values",
                       "write soil.friction_angle: [26, 28, 30]");
    validate(root, root.IsMap(), "not a sweep", "it names keys of the case and lists of their values",
             "write soil.friction_angle: [26, 28, 30]");
    for (const auto& entry : root) {
      const std::string key = key_of(entry.first);
      validate(entry.first, seen_.insert(key).second, key + " is given twice", "its values are one list",
               "leave one of them out");
      if (key == "runs")
        read_runs(entry.second);
      else
        read_key(key, entry.first, entry.second);
    }
    for (const auto& [key, place] : in_runs_)
      if (seen_.count(key))
        throw InputError(place + ": " + key + " is given twice", "runs and the sweep itself both set it",
                         "leave one of them out");
    if (axes_.empty())
      throw InputError(name_ + ": nothing is swept", "no key has a list of values",
                       "write soil.friction_angle: [26, 28, 30]");
  }

  const std::vector<Setting>& constants() const { return constants_; }
  const std::vector<std::string>& keys() const { return keys_; }

  /// Every choice of one axis with every choice of the others, the last axis fastest.
  std::vector<Choice> combinations() const {
    std::size_t count = 1;
    for (const auto& axis : axes_) count = std::min(count * axis.size(), max_runs + 1);
    if (count > max_runs)
      throw InputError(name_ + ": more than " + std::to_string(max_runs) + " runs",
                       "every value is run with every other", "shorten the lists, or name the runs one by one in runs");
    std::vector<Choice> all(1);
    for (const auto& axis : axes_) {
      std::vector<Choice> longer;
      for (const Choice& before : all)
        for (const Choice& choice : axis) {
          longer.push_back(before);
          longer.back().settings.insert(longer.back().settings.end(), choice.settings.begin(), choice.settings.end());
          std::string& name = longer.back().name;
          name += (name.empty() ? "" : ",") + name_of(choice);
        }
      all = std::move(longer);
    }
    return all;
  }

 private:
  std::string place(const YAML::Node& node) const { return name_ + ":" + std::to_string(node.Mark().line + 1); }
  void validate(const YAML::Node& node, bool sound, const std::string& problem, const std::string& why,
                const std::string& suggestion) const {
    if (!sound) throw InputError(place(node) + ": " + problem, why, suggestion);
  }

  std::string key_of(const YAML::Node& node) const {
    validate(node, node.IsScalar(), "a key is no word", "a sweep names keys of the case",
             "write section.key: [values]");
    const std::string key = node.Scalar();
    validate(node, key != "name", "name is no key to sweep", "it names the case, not a run",
             "name a run in runs: - {name: ..., key: value}");
    return key;
  }

  void read_key(const std::string& key, const YAML::Node& key_node, const YAML::Node& value) {
    if (value.IsMap())
      validate(key_node, false, key + " is a mapping of keys", "keys of a sweep are dotted",
               "write " + key + (value.size() > 0 ? "." + key_of(value.begin()->first) : ".key") + ": [values]");
    if (!value.IsSequence()) return constants_.push_back({key, value, place(key_node)});
    validate(key_node, value.size() > 0, key + " has no values", "an empty list makes no runs", "give it some");
    std::vector<Choice> axis;
    for (std::size_t k = 0; k < value.size(); ++k)
      axis.push_back({"", {{key, value[k], value[k].Mark().is_null() ? place(key_node) : place(value[k]), k + 1}}});
    axes_.push_back(std::move(axis));
    keys_.push_back(key);
  }

  void read_runs(const YAML::Node& runs) {
    validate(runs, runs.IsSequence() && runs.size() > 0, "runs is no list of runs", "each item is a run",
             "write runs: - {name: worst, soil.friction_angle: 24, water.level: 745}");
    std::vector<Choice> axis;
    for (const YAML::Node& item : runs) {
      validate(item, item.IsMap(), "a run is no mapping of keys", "it says what it changes",
               "write - {name: worst, soil.friction_angle: 24}");
      Choice choice;
      for (const auto& entry : item) {
        if (entry.first.IsScalar() && entry.first.Scalar() == "name") {
          choice.name = run_name(entry.second);
          continue;
        }
        const std::string key = key_of(entry.first);
        choice.settings.push_back({key, entry.second, place(entry.first), axis.size() + 1});
        if (std::find(keys_.begin(), keys_.end(), key) == keys_.end()) keys_.push_back(key);
        in_runs_.emplace(key, place(entry.first));
      }
      validate(item, !choice.settings.empty() || !choice.name.empty(), "a run has neither name nor keys",
               "its folder is named after them", "write - {name: as_it_is} for the case as it is");
      axis.push_back(std::move(choice));
    }
    axes_.push_back(std::move(axis));
  }

  std::string run_name(const YAML::Node& node) const {
    const std::string text = node.IsScalar() ? node.Scalar() : "";
    const bool sound =
        !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) &&
        std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || std::strchr("._-", c); });
    validate(node, sound, "\"" + text + "\" is no name of a run", "it names a folder",
             "write a letter, then letters, digits and _ . -");
    return text;
  }

  std::string name_of(const Choice& choice) const {
    if (!choice.name.empty()) return choice.name;
    std::string name;
    for (const Setting& setting : choice.settings)
      name += (name.empty() ? "" : ",") + short_key(setting.key, keys_) + "=" + short_value(setting);
    return name;
  }

  std::string name_;
  std::set<std::string> seen_;
  std::map<std::string, std::string> in_runs_;  // key -> place
  std::vector<Setting> constants_;
  std::vector<std::string> keys_;
  std::vector<std::vector<Choice>> axes_;
};

/// The value of a dotted key in a case's text on one line; "" where it has none.
std::string value_of(const YAML::Node& node, const std::string& key) {
  if (key.empty()) return one_line(node);
  const std::string word = key.substr(0, key.find('.'));
  const std::string rest = word.size() < key.size() ? key.substr(word.size() + 1) : "";
  if (node.IsMap() && node[word].IsDefined()) return value_of(node[word], rest);
  const bool number = std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c); });
  if (node.IsSequence() && number && std::stoul(word) < node.size()) return value_of(node[std::stoul(word)], rest);
  return "";
}

}  // namespace

Sweep parse_sweep(const std::string& text, const std::string& name, const std::string& case_text,
                  const std::string& case_name, const std::vector<std::string>& overrides) {
  const SweepReader reader(name, parse_yaml(text, name));
  std::vector<Override> base;
  for (const std::string& option : overrides) base.push_back(override_of_option(option));
  parse_overridden_case(case_text, case_name, base);  // an unsound case is not the sweep's fault

  Sweep sweep{reader.keys(), {}};
  std::set<std::string> names;
  for (const Choice& choice : reader.combinations()) {
    SweepRun run;
    run.name = choice.name;
    std::vector<Override> all = base;
    for (const auto* settings : {&reader.constants(), &choice.settings})
      for (const Setting& setting : *settings) {
        run.overrides.push_back(setting.key + "=" + one_line(setting.value));
        all.push_back({run.overrides.back(), setting.place});
      }
    if (run.name.size() > max_name)
      throw InputError(name + ": the name of a run has " + std::to_string(run.name.size()) + " letters",
                       "it names a folder", "write the runs one by one in runs, with names");
    if (!names.insert(run.name).second)
      throw InputError(name + ": two runs are called " + run.name, "each has a folder of its own",
                       "leave one out, or name them in runs");
    run.case_text =
        all.empty() ? YAML::Dump(YAML::Load(case_text)) + "\n" : parse_overridden_case(case_text, case_name, all).text;
    const YAML::Node document = YAML::Load(run.case_text);
    for (const std::string& key : sweep.keys) run.inputs.push_back(value_of(document, key));
    sweep.runs.push_back(std::move(run));
  }
  return sweep;
}

Sweep read_sweep(const std::string& path, const std::string& case_path, const std::vector<std::string>& overrides) {
  LGIW_VALIDATE(path != "-" || case_path != "-", "case and sweep both come from stdin", "it holds one of them",
                "name a file for the other");
  const auto name = [](const std::string& p) { return p == "-" ? "stdin" : p; };
  const std::string case_text = read_case_text(case_path, "a case file");
  return parse_sweep(read_case_text(path, "a sweep file"), name(path), case_text, name(case_path), overrides);
}

}  // namespace lgiw
