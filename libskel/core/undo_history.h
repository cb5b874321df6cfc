// Steps that can be undone, and done again.
#pragma once

#include <cstddef>
#include <deque>
#include <utility>

namespace skel {

template <class Step>
class UndoHistory {
 public:
  // Older steps than the last `most` are forgotten.
  explicit UndoHistory(std::size_t most) : most_(most) {}

  // A new one: what was undone cannot be done again.
  void push(Step step) {
    done_.push_back(std::move(step));
    if (done_.size() > most_) done_.pop_front();
    undone_.clear();
  }
  bool canUndo() const { return !done_.empty(); }
  bool canRedo() const { return !undone_.empty(); }
  // change(step) of all steps, where something that they name has moved.
  template <class Change>
  void forEach(const Change& change) {
    for (Step& step : done_) change(step);
    for (Step& step : undone_) change(step);
  }
  // `travel(step)` goes back, or forth, over the last step and may change it for the way back; false: it did
  // not, and nothing changes. False if there is no step, too.
  template <class Travel>
  bool undo(const Travel& travel) {
    return over(done_, undone_, travel);
  }
  template <class Travel>
  bool redo(const Travel& travel) {
    return over(undone_, done_, travel);
  }

 private:
  template <class Travel>
  static bool over(std::deque<Step>& from, std::deque<Step>& to, const Travel& travel) {
    if (from.empty() || !travel(from.back())) return false;
    to.push_back(std::move(from.back()));
    from.pop_back();
    return true;
  }

  std::size_t most_;
  std::deque<Step> done_, undone_;
};

}  // namespace skel
