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

namespace ringlet::test {
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
  for (const char* program : {"consumer/main.cpp", "installed/engine.cpp"}) {
    const std::string text = textOf(fs::path("tests/package") / program);
    EXPECT_GT(text.size(), 100u);
    EXPECT_NE(library.find("```cpp\n" + text + "```\n"), std::string::npos) << program;
  }
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
}  // namespace ringlet::test
