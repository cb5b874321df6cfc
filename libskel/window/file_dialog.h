// Asks for a file to open or to save, in a window with Dear ImGui: folders to go through, names to choose or
// type.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>

#include "libskel/core/folder_listing.h"

namespace skel {

enum class FileUse {
  kOpen,
  kOpenFileOrFolder,
  kSave,
  kSaveFileOrFolder,  // a folder if the name ends with '/'
};

struct FileQuestion {
  std::string title, button;  // "Save the pose", "Save"
  std::string kind;           // "pose": the next question of this kind begins where this one ended
  // A path; of the first question of its kind, where it begins: of one to open without the name of a file
  // that is not there.
  std::string suggestion;
  FileUse use = FileUse::kOpen;
  // Which names are shown, unless all are asked for; empty: all.
  std::function<bool(const std::string& name)> shows = {};
  // What a typed name gets that has none of skel's own (withEnding()), to open where there is no such file;
  // empty: names are left as typed.
  std::string ending = {};
  // What is done with the answer; "" if it was done, else why not.
  std::function<std::string(const std::string& path)> answer = {};
  // More to choose, between names and buttons.
  std::function<void()> options = {};
  bool begins_there = false;  // at the suggestion, whatever was asked before
};

class FileDialog {
 public:
  void ask(FileQuestion question);
  // Keys belong to it, also in the frame in which it closes.
  bool isOpen() const { return open_; }
  // Once a frame, inside a Dear ImGui window.
  void draw();

 private:
  void enter(const std::string& folder);
  void goTo(const std::string& folder);  // and what is to be opened is chosen anew
  void setName(const std::string& name);
  // An entry of the list; whether it was chosen twice in a row.
  bool entry(const std::string& name, bool is_folder);
  void drawPlace();
  // Whether a file was chosen twice in a row.
  bool drawNames(float height);
  // Where the name leads.
  std::string path() const;
  // `sees_replace`: by a button that says so; else what would be written over is asked about first.
  void answer(bool sees_replace);
  bool saves() const;
  bool replaces() const;

  FileQuestion question_;
  FolderListing listing_;
  std::map<std::string, std::string> places_;  // of kinds
  std::array<char, 4096> name_{};
  std::string problem_;
  std::string asked_;  // the path whose file may be replaced if the same answer comes once more
  bool open_ = false, opens_ = false, types_on_ = false, shows_all_ = false, scrolls_up_ = false;
};

}  // namespace skel
