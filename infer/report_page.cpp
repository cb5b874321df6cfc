#include "infer/report_page.h"

#include <cmath>
#include <filesystem>

#include "embedded/report_css.h"
#include "infer/advice.h"
#include "libskel/core/json_names.h"
#include "libskel/core/text.h"
#include "libskel/core/tool_command.h"

namespace skel {
namespace {

// Text of any bytes for HTML, in UTF-8.
std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : jsonFromFileName(text)) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
    }
  }
  return html;
}

// Text with `commands` in it.
std::string proseHtml(const std::string& text) {
  std::string html;
  std::size_t begin = 0;
  for (std::size_t from; (from = text.find('`', begin)) != text.npos;) {
    const std::size_t to = text.find('`', from + 1);
    if (to == text.npos) break;
    html += escaped(text.substr(begin, from - begin)) + "<code>" +
            escaped(text.substr(from + 1, to - from - 1)) + "</code>";
    begin = to + 1;
  }
  return html + escaped(text.substr(begin));
}

constexpr const char* kMender = "skel-label";

// One card of the page: a figure, or a drawing of which there is none.
struct Card {
  std::string name;                        // HTML
  const FigureResult* figure = nullptr;    // or
  const DrawingResult* without = nullptr;  // that has none

  bool again() const { return figure ? figure->verdict == Verdict::kRetake : without->nothing_found; }
  bool fine() const { return figure && figure->verdict == Verdict::kFine; }
  std::string problem() const { return without->nothing_found ? kAdviceOnNothing : without->problem; }
};

std::vector<Card> cardsOf(const std::vector<DrawingResult>& drawings) {
  std::vector<Card> cards;
  for (const DrawingResult& drawing : drawings) {
    const std::string name = std::filesystem::path(drawing.source).stem().string();
    for (const FigureResult& figure : drawing.figures)
      cards.push_back(
          {escaped(drawing.figures.size() > 1 ? name + " " + std::to_string(figure.number) : name), &figure});
    if (!drawing.error.empty()) cards.push_back({escaped(name), nullptr, &drawing});
  }
  return cards;
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + "%"; }

std::string film(const Card& card) {
  const FilmSheet& sheet = card.figure->pictures.film;
  if (sheet.columns == 0) return "";
  char style[160];
  std::snprintf(style, sizeof style, "--columns:%d;--rows:%d;--lasts:%.3fs;--line-lasts:%.3fs", sheet.columns,
                sheet.rows, sheet.duration_s, sheet.duration_s / sheet.rows);
  return "<div class=\"film\" style=\"" + std::string(style) + "\"><div><img alt=\"" + card.name +
         ", moving\" src=\"" + sheet.source + "\"></div><img class=\"rest\" alt=\"" + card.name +
         ", at rest\" src=\"" + sheet.rest + "\"></div>";
}

std::string verdictChip(const Card& card) {
  if (card.again()) return "<span class=\"chip again\">mend or retake</span>";
  if (!card.figure) return "<span class=\"chip look\">no figure</span>";
  return card.fine() ? "<span class=\"chip fine\">fine</span>"
                     : "<span class=\"chip look\">look at it</span>";
}

// The path of the tool, which stands once above, is not said in each sentence.
std::string toldHtml(std::string text) {
  const std::string command = toolCommand(kMender), name = kMender;
  for (std::size_t at = text.find(command + " "); at != text.npos;
       at = text.find(command + " ", at + name.size()))
    text.replace(at, command.size(), name);
  return proseHtml(text);
}

std::string cardHtml(const Card& card, std::size_t number) {
  std::string html = "<article id=\"d" + std::to_string(number) +
                     (!card.figure  ? "\" class=\"none\"><h2>"
                      : card.fine() ? "\"><h2>"
                                    : "\" class=\"doubt\"><h2>") +
                     card.name + "</h2>" + verdictChip(card);
  const auto drawn = [&](const std::string& picture) {
    return "<img class=\"drawing\" alt=\"" + card.name + ", as drawn\" src=\"" + picture + "\">";
  };
  if (!card.figure) {
    if (!card.without->picture.empty())
      html += "<div class=\"pair\">" + drawn(card.without->picture) + "</div>";
    return html + "<p class=\"advice\">" + toldHtml(card.problem()) + "</p></article>\n";
  }
  const FigureResult& figure = *card.figure;
  const double sure = figure.confidence.value_or(0);
  html += "<div class=\"pair\">" + drawn(figure.pictures.drawing) + film(card) + "</div>";
  html += figure.all_placed ? "<p class=\"sure\">a person has placed the joints</p>"
                            : "<p class=\"sure\"><span><i style=\"width:" + percent(sure) + "\"></i></span>" +
                                  percent(sure) +
                                  (figure.placed > 0 ? " sure of the joints that no person has placed</p>"
                                                     : " sure of the joints</p>");
  for (const std::string& sentence : figure.advice)
    html += "<p class=\"advice\">" + toldHtml(sentence) + "</p>";
  for (const Note& note : figure.notes)
    html += "<p class=\"note\">" + toldHtml(noteText(note, figure.mend_file)) + "</p>";
  return html + "</article>\n";
}

std::string inOneLine(const std::vector<std::string>& sentences) {
  std::string line;
  for (const std::string& sentence : sentences) line += (line.empty() ? "" : " ") + sentence;
  return line;
}

// All that is said of it.
std::string reasonsFor(const Card& card) {
  return card.figure ? inOneLine(card.figure->advice) : card.problem();
}

// One line a drawing; "" where there is none.
std::string listHtml(const char* look, const char* title, const std::string& lines) {
  if (lines.empty()) return "";
  return "<section class=\"" + std::string(look) + "\"><h2>" + title + "</h2><ul>\n" + lines +
         "</ul></section>\n";
}

}  // namespace

std::string reportPage(const std::vector<DrawingResult>& drawings) {
  const std::vector<Card> cards = cardsOf(drawings);
  std::size_t fine = 0, look = 0, retake = 0, without = 0, shown = 0;
  std::string again, look_at, not_used, left_out, all;
  for (std::size_t i = 0; i < cards.size(); ++i) {
    const Card& card = cards[i];
    all += cardHtml(card, i + 1);
    shown += card.figure != nullptr;
    ++(card.again() ? retake : !card.figure ? without : card.fine() ? fine : look);
    const auto line = [&](const std::string& text) {
      return "<li><a href=\"#d" + std::to_string(i + 1) + "\">" + card.name + "</a> " + toldHtml(text) +
             "</li>\n";
    };
    if (!card.fine()) (card.again() ? again : card.figure ? look_at : not_used) += line(reasonsFor(card));
    std::vector<std::string> mended;
    if (card.figure)
      for (const Note& note : card.figure->left_out) mended.push_back(note.what);
    if (!mended.empty()) left_out += line(joined(mended));
  }
  const bool of_figures = cards.size() > drawings.size();
  const auto countedCards = [of_figures](std::size_t count) {
    return of_figures ? counted(count, "figure", "figures") : counted(count, "drawing", "drawings");
  };
  const std::string title = countedCards(cards.size());
  std::string heading = title;
  const bool choose = fine > 0 && fine < shown;  // the good ones, among the pictures
  if (shown < cards.size() || choose)
    heading =
        "<span class=\"all\">" + title + "</span><span class=\"shown\">" + countedCards(shown) + "</span>";
  if (choose) heading += "<span class=\"good\">" + countedCards(fine) + "</span>";
  std::string summary = std::to_string(fine) + " fine";
  if (look > 0) summary += ", " + std::to_string(look) + " to look at";
  if (retake > 0) summary += ", " + std::to_string(retake) + " to mend or take again";
  if (without > 0) summary += ", " + std::to_string(without) + " without a figure";
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
      "'unsafe-inline'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" +
      title + ", moving</title>\n<style>\n" + std::string(embedded::report_css) +
      "</style></head>\n<body>\n<input type=\"checkbox\" id=\"still\"><input type=\"checkbox\" "
      "id=\"pictures\">" +
      (choose ? "<input type=\"checkbox\" id=\"good\">" : "") + "\n<header><h1>" + heading + "</h1><p>" +
      summary + "</p><label for=\"still\">stand still</label><label for=\"pictures\">pictures alone</label>" +
      (choose ? "<label for=\"good\">only the good ones</label>" : "") + "</header>\n";
  if (const std::string command = toolCommand(kMender);
      command != kMender && all.find(kMender) != std::string::npos)
    html += "<p class=\"tool\">" + std::string(kMender) + " is " + proseHtml(command) + "</p>\n";
  html += listHtml("again", "Mend these, or take the photo again", again) +
          listHtml("look", "Drawings to look at", look_at) +
          listHtml("look", "Files without a figure", not_used) +
          listHtml("look", "What was mended of an earlier photo, and is left out", left_out);
  return html + "<main>\n" + all + "</main>\n</body></html>\n";
}

}  // namespace skel
