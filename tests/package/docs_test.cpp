// The pages of the documentation: their programs are those that tests build, their links lead somewhere,
// every page is linked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace ringlet::test::docs_test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = RINGLET_SOURCE_DIR;

std::string textOf(const fs::path& file) {
  std::ifstream in(kRoot / file);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<fs::path> pages() {
  std::vector<fs::path> found = {"README.md", "CONTRIBUTING.md"};
  for (const fs::path folder : {"docs", "examples"})
    for (const auto& entry : fs::directory_iterator(kRoot / folder))
      if (entry.path().extension() == ".md") found.push_back(folder / entry.path().filename());
  return found;
}

/// The page without its blocks of code.
std::string proseOf(const std::string& page) {
  std::istringstream lines(page);
  std::string prose;
  bool isCode = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```"))
      isCode = !isCode;
    else if (!isCode)
      prose += line + "\n";
  }
  return prose;
}

/// The anchors of a page's headings, as GitHub makes them: lower case, spaces as hyphens, no punctuation.
std::set<std::string> anchorsOf(const std::string& page) {
  std::istringstream lines(proseOf(page));
  std::set<std::string> anchors;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("#")) continue;
    std::string anchor;
    for (const char c : line.substr(line.find(' ') + 1)) {
      if (c == ' ')
        anchor += '-';
      else if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    anchors.insert(anchor);
  }
  return anchors;
}

struct Link {
  fs::path page, target;  // the target from the root of the repository
  std::string anchor;
};

std::vector<Link> localLinks() {
  std::vector<Link> links;
  const std::regex pattern(R"(\]\(([^)\s#]*)(?:#([^)\s]*))?\))");
  for (const fs::path& page : pages()) {
    const std::string prose = proseOf(textOf(page));
    for (std::sregex_iterator match(prose.begin(), prose.end(), pattern), end; match != end; ++match) {
      const std::string target = (*match)[1];
      if (target.starts_with("http")) continue;
      const fs::path file = target.empty() ? page : (page.parent_path() / target).lexically_normal();
      links.push_back({page, file, (*match)[2]});
    }
  }
  return links;
}

TEST(Docs, ShowTheProgramsThatTestsBuild) {
  const std::string library = textOf("docs/library.md");
  for (const std::string program :
       {"consumer/main.cpp", "installed/engine.cpp", "installed/film.cpp", "installed/film.c"}) {
    const std::string text = textOf(fs::path("tests/package") / program);
    EXPECT_GT(text.size(), 100u);
    const std::string language = fs::path(program).extension().string().substr(1);
    EXPECT_NE(library.find("```" + language + "\n" + text + "```\n"), std::string::npos) << program;
  }
}

// Without spaces, and without check(...) around calls of C, which has no overloads to leave it out of.
std::string squeezed(std::string text, bool isC) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
  return isC ? std::regex_replace(text, std::regex("check\\((ringlet_.*?\\))\\);"), "$1;") : text;
}

// Each line of code in the table is one of the programs', which tests run.
TEST(Docs, TheLibrarysTableIsRun) {
  const std::string library = textOf("docs/library.md");
  const std::string cpp = squeezed(textOf("tests/package/installed/table.cpp"), false);
  const std::string c = squeezed(textOf("tests/package/installed/table.c"), true);
  const std::size_t begin = library.find("| I want to | C++ | C |");
  ASSERT_NE(begin, std::string::npos);
  std::istringstream table(library.substr(begin, library.find("\n\n", begin) - begin));
  const std::regex span("`([^`]*)`"), comment(" // .*");
  std::size_t count = 0;
  for (std::string row; std::getline(table, row);) {
    for (std::sregex_iterator at(row.begin(), row.end(), span), end; at != end; ++at, ++count) {
      const std::string line = std::regex_replace((*at)[1].str(), comment, "");
      const bool isC =
          row.find(" | ") < row.rfind(" | ") && static_cast<std::size_t>(at->position()) > row.rfind(" | ");
      std::string wanted = squeezed(line, isC);
      if (!wanted.empty() && wanted.back() == ';') wanted.pop_back();
      EXPECT_NE((isC ? c : cpp).find(wanted), std::string::npos) << line;
    }
  }
  EXPECT_GT(count, 40u);
}

TEST(Docs, NameFunctionsOfCThatThereAre) {
  const std::string headers = textOf("src/ringlet/c/ringlet.h") + textOf("src/ringlet/c/ringlet_io.h");
  const std::regex name("\\bringlet_[a-z_0-9]+\\b");
  std::size_t count = 0;
  for (const fs::path& page : pages()) {
    const std::string text = textOf(page);
    for (std::sregex_iterator at(text.begin(), text.end(), name), end; at != end; ++at) {
      const bool isCalled = text[static_cast<std::size_t>(at->position() + at->length())] == '(';
      if (!isCalled) continue;
      ++count;
      EXPECT_TRUE(std::regex_search(headers, std::regex("\\b" + at->str() + "\\b")))
          << page << ": " << at->str();
    }
  }
  EXPECT_GT(count, 20u);
}

// Headers that are installed must not be left out of the list, and the list is what find_package gives.
TEST(Docs, TheLibrarysTableNamesHeadersThatAreInstalled) {
  const std::string library = textOf("docs/library.md"), installed = textOf("src/CMakeLists.txt");
  const std::regex link("\\.\\./src/ringlet/([a-z_/]+\\.h)\\)");
  std::size_t count = 0;
  for (std::sregex_iterator at(library.begin(), library.end(), link), end; at != end; ++at, ++count)
    EXPECT_NE(installed.find((*at)[1].str()), std::string::npos) << (*at)[1] << " is not installed";
  EXPECT_GT(count, 15u);
}

TEST(Docs, LinksLeadSomewhere) {
  const auto links = localLinks();
  EXPECT_GT(links.size(), 100u);
  for (const Link& link : links) {
    EXPECT_TRUE(fs::exists(kRoot / link.target)) << link.page << " links to " << link.target;
    const bool isAnchor = !link.anchor.empty() && link.target.extension() == ".md";
    EXPECT_TRUE(!isAnchor || anchorsOf(textOf(link.target)).contains(link.anchor))
        << link.page << " links to #" << link.anchor << " of " << link.target;
  }
}

TEST(Docs, EveryPageIsLinkedFromAnother) {
  const auto links = localLinks();
  for (const fs::path& page : pages()) {
    const bool isLinked = std::ranges::any_of(
        links, [&](const Link& link) { return link.target == page && link.page != page; });
    EXPECT_TRUE(isLinked || page == "README.md") << page;
  }
}

TEST(Docs, EveryPackageThatIsInstalledIsListed) {
  const std::string page = textOf("docs/getting-started.md");
  std::istringstream script(textOf("scripts/install_packages.sh"));
  std::set<std::string> packages;
  bool isList = false;
  for (std::string line; std::getline(script, line);) {
    if (line == ")") isList = false;
    std::istringstream words(line.substr(0, line.find('#')));
    for (std::string word; isList && words >> word;) packages.insert(word);
    if (line.ends_with("=(")) isList = true;
  }
  EXPECT_GT(packages.size(), 30u);
  for (const std::string& package : packages) {
    const std::regex whole("[` ]" + std::regex_replace(package, std::regex("[+]"), "[+]") + "[` ]");
    EXPECT_TRUE(std::regex_search(page, whole)) << package << " is not in the table of packages";
  }
}

TEST(Docs, TheReadmeIsShort) {
  const std::string readme = textOf("README.md");
  EXPECT_LE(std::ranges::count(readme, '\n'), 160);
}

}  // namespace
}  // namespace ringlet::test::docs_test
