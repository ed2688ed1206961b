#include "common/toml_string.hpp"

#include <doctest/doctest.h>

#include <string>

#include "base/toml_input.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;

namespace {

std::string read_back(const std::string& text) {
  const TemporaryFolder folder;
  return TomlFile(folder.write("file.toml", "key = " + toml_string(text) + " # comment\n"), "file").root({"key"}).text("key");
}

}  // namespace

TEST_CASE("strings are written so that they read back") {
  for (const std::string text : {"plain", "with \"quotes\"", "C:\\grains\\new", "it's", "'''", "line\nfeed", "tab\t", "\x01\x7f",
                                 "Schüttgut", "# no comment", "]"}) {
    CAPTURE(text);
    CHECK(read_back(text) == text);
    CHECK(toml_string(text).find('\n') == std::string::npos);
  }
  CHECK(toml_string("plain") == "\"plain\"");
  CHECK(read_back("Latin-1: \xfc") == "Latin-1: ü");
}
