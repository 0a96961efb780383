#include "base/provenance.hh"

#include <openssl/evp.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/error.hh"
#include "version.hh"

namespace lgiw {
namespace {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) throw std::bad_alloc();
  }
  void add(const void* data, std::size_t size) { EVP_DigestUpdate(context_.get(), data, size); }
  std::string hex() {
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned size = 0;
    EVP_DigestFinal_ex(context_.get(), digest, &size);
    std::string text;
    for (unsigned i = 0; i < size; ++i) {
      text += "0123456789abcdef"[digest[i] >> 4];
      text += "0123456789abcdef"[digest[i] & 15];
    }
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context_;
};

}  // namespace

void Provenance::add_input(const std::string& path) {
  std::error_code none;
  // A pipe cannot be read twice; sha256_of_file() says of what is not there that it cannot be read.
  const std::filesystem::file_status status = std::filesystem::status(path, none);
  const bool stream = path == "-" || (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status));
  inputs.emplace_back(path == "-" ? "stdin" : path, stream || !enabled ? "" : sha256_of_file(path));
}

void Provenance::add_text(const std::string& name, const std::string& text) {
  if (enabled) inputs.emplace_back(name, sha256_of_text(text));
}

std::string Provenance::to_json() const {
  if (!enabled) return "{}";
  nlohmann::ordered_json json = {{"tool", tool}, {"version", version}, {"command_line", command_line}};
  json["inputs"] = nlohmann::ordered_json::array();
  for (const auto& [path, sha256] : inputs) {
    json["inputs"].push_back({{"path", path}, {"sha256", nullptr}});
    if (!sha256.empty()) json["inputs"].back()["sha256"] = sha256;
  }
  // A file name need not be UTF-8; JSON must be.
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string version_string() { return LGIW_VERSION; }

std::string sha256_of_file(const std::string& path) { return sha256_of_start(path, UINT64_MAX); }

std::string sha256_of_start(const std::string& path, uint64_t size) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  const auto refuse = [&path] {
    throw InputError(path + " cannot be read", std::strerror(errno), "check the name and its permissions");
  };
  if (!file) refuse();
  Sha256 sha256;
  std::vector<char> buffer(1 << 20);
  for (std::size_t n; size > 0; size -= n) {
    n = std::fread(buffer.data(), 1, std::size_t(std::min<uint64_t>(buffer.size(), size)), file.get());
    if (n == 0) break;
    sha256.add(buffer.data(), n);
  }
  if (std::ferror(file.get())) refuse();
  return sha256.hex();
}

std::string sha256_of_text(const std::string& text) {
  Sha256 sha256;
  sha256.add(text.data(), text.size());
  return sha256.hex();
}

}  // namespace lgiw
