#include "libskel/image/named_drawings.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>

#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/foreign_files.h"
#include "libskel/core/natural_order.h"
#include "libskel/core/text.h"
#include "libskel/image/animated_picture.h"
#include "libskel/image/result_picture.h"
#include "libskel/image/sprite_sheet_file.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

// The texture of an .obj, which has the drawing's name.
bool isTexture(const fs::path& picture) {
  return picture.extension() == ".png" && fs::exists(fs::path(picture).replace_extension(".mtl"));
}

bool isDocument(const fs::path& file) {
  const std::string ending = file.extension().string();
  return ending == ".pdf" || ending == ".PDF";
}

bool isDrawing(const fs::directory_entry& entry) {
  std::error_code unknown;
  return isDrawingName(entry.path().filename().string()) && !entry.is_directory(unknown) &&
         !entry.is_other(unknown) && !isTexture(entry.path()) && atlasBeside(entry.path().string()).empty();
}

bool isFilm(const fs::directory_entry& entry) {
  const std::string ending = endingOf(entry.path().string());
  return (ending == ".gif" || ending == ".webp") && isDrawing(entry) &&
         isAnimatedPicture(entry.path().string());
}

// Not of a hidden folder, nor of one that skel-infer has made of a drawing.
bool holdsDrawings(const fs::path& folder) {
  if (folder.filename().string().starts_with('.') || fs::exists(folder / "char_cfg.yaml")) return false;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure))
    if (isDrawing(*entry)) return true;
  return false;
}

std::vector<std::string> drawingsIn(const fs::path& dir, NamedDrawings& found) {
  std::vector<std::string> names, passed_over, films;
  std::error_code failure;
  for (fs::directory_iterator entry(dir, failure), end; !failure && entry != end; entry.increment(failure)) {
    const fs::path& path = entry->path();
    std::error_code unknown;
    if (isDocument(path)) passed_over.push_back(path.string());
    if (isFilm(*entry))
      films.push_back(path.string());
    else if (isDrawing(*entry))
      names.push_back(path.filename().string());
    if (entry->is_directory(unknown) && holdsDrawings(path)) found.folders.push_back(path.string());
  }
  if (failure) throw InputError(dir.string(), "cannot be read: " + failure.message());
  std::sort(passed_over.begin(), passed_over.end(), comesBefore);
  if (names.empty() && !passed_over.empty())
    throw InputError(passed_over.front(), howToConvert(passed_over.front()));
  std::sort(films.begin(), films.end(), comesBefore);
  found.films.insert(found.films.end(), films.begin(), films.end());
  found.documents.insert(found.documents.end(), passed_over.begin(), passed_over.end());
  if (names.empty())
    throw InputError(dir.string(), "holds no drawing (" + std::string(kPictureEndings) +
                                       "); folders in it are not looked into" +
                                       (films.empty() ? "" : ", and films are none"));
  passOverConverted(names);
  std::sort(names.begin(), names.end(), comesBefore);
  for (std::string& name : names) name = (dir / name).string();
  return names;
}

}  // namespace

NamedDrawings drawingsOf(const std::vector<std::string>& named) {
  NamedDrawings found;
  std::vector<std::string> pictures;
  std::set<std::string> from_folders;
  std::set<fs::path> folders;
  for (const std::string& name : named) {
    std::error_code not_there;
    if (!fs::is_directory(name, not_there)) {
      pictures.push_back(name);
      continue;
    }
    folders.insert(fs::canonical(name));
    for (std::string& drawing : drawingsIn(name, found)) {
      from_folders.insert(drawing);
      pictures.push_back(std::move(drawing));
    }
  }
  std::erase_if(found.folders,
                [&](const std::string& folder) { return folders.contains(fs::canonical(folder)); });
  std::sort(found.folders.begin(), found.folders.end(), comesBefore);

  std::set<fs::path> without_endings;
  for (const std::string& picture : pictures) without_endings.insert(fs::path(picture).replace_extension());
  const auto isResult = [&](const std::string& picture) {
    if (pictures.size() < 2 || from_folders.contains(picture)) return false;
    const auto isMadeOfOne = [&](std::string_view ending) {
      if (!picture.ends_with(ending)) return false;
      const std::string drawing = picture.substr(0, picture.size() - ending.size());
      return without_endings.contains(drawing) || fs::exists(drawing + ".skeleton.json");
    };
    return isMadeOfOne(".back.png") ||
           std::any_of(kResultPictureEndings.begin(), kResultPictureEndings.end(), isMadeOfOne) ||
           !atlasBeside(picture).empty();
  };
  for (std::string& picture : pictures)
    (isResult(picture) ? found.results : found.drawings).push_back(std::move(picture));
  if (found.drawings.empty() && !pictures.empty())
    throw UsageError("none of the images is a drawing; name one of them alone to rig it all the same");
  return found;
}

std::optional<NameClash> nameClash(const std::vector<std::string>& files,
                                   const std::vector<std::string>& names) {
  std::map<std::string, std::string> file_of_name;
  std::optional<NameClash> clash;
  std::vector<std::string> more;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto [other, is_new] = file_of_name.emplace(names[i], files[i]);
    if (is_new) continue;
    if (clash)
      more.push_back(other->second + " and " + files[i]);
    else
      clash = {other->second, files[i], names[i], ""};
  }
  if (!more.empty()) clash->more = ", as would " + firstFew(more);
  return clash;
}

std::vector<std::string> notesOf(const NamedDrawings& named) {
  std::vector<std::string> notes;
  if (!named.results.empty())
    notes.push_back("no drawings but what was made of some, left out: " + joined(named.results));
  // A PDF is no picture, but somebody may wait for its pages.
  for (const std::string& file : named.documents)
    notes.push_back(file + " " + howToConvert(file) + "; passed over");
  if (!named.films.empty())
    notes.push_back("films, no drawings, passed over (one that is named is taken by its first frame): " +
                    joined(named.films));
  if (const std::size_t count = named.folders.size(); count > 0)
    notes.push_back(std::to_string(count) + (count == 1 ? " folder" : " folders") +
                    " in there with drawings, not looked into; name " + (count == 1 ? "it" : "them") +
                    ", too: " + joined(named.folders));
  return notes;
}

}  // namespace skel
