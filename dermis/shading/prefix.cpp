#include "dermis/shading/shading.h"

#include <map>
#include <string>

#include "dermis/shading/lexer.h"

namespace dermis::shading {
namespace {

class Prefixer {
  public:
    void declare(const Item& item) {
        if (!item.name.empty() && !item.name.starts_with("skin_")) renamed_[item.name] = "skin_" + item.name;
        for (const Statement& statement : item.constants)
            for (const Declarator& constant : statement.declarators)
                if (constant.name.starts_with('k') && !constant.name.starts_with("kSkin"))
                    renamed_[constant.name] = "kSkin" + constant.name.substr(1);
    }

    void rename(Unit& unit) const {
        lines(unit.header);
        for (Item& item : unit.items) {
            word(item.name);
            comments(item.comments);
            statements(item.body);
            statements(item.constants);
        }
    }

  private:
    void word(std::string& name) const {
        if (const auto found = renamed_.find(name); found != renamed_.end()) name = found->second;
    }

    void line(std::string& text) const {
        std::string renamed;
        for (size_t i = 0; i < text.size();) {
            size_t end = i;
            while (end < text.size() && is_word(text[end])) ++end;
            if (end == i) ++end;
            std::string part = text.substr(i, end - i);
            word(part);
            renamed += part;
            i = end;
        }
        text = renamed;
    }

    void lines(std::vector<std::string>& text) const {
        for (std::string& one : text) line(one);
    }

    void comments(Comments& comments) const {
        lines(comments.before);
        line(comments.behind);
    }

    void expression(Expression& e) const {
        if (e.kind == Expression::Kind::name || e.kind == Expression::Kind::call) word(e.text);
        for (Expression& child : e.children) expression(child);
    }

    void statements(std::vector<Statement>& body) const {
        for (Statement& s : body) {
            comments(s.comments);
            for (Declarator& declarator : s.declarators) {
                word(declarator.name);
                if (declarator.value) expression(*declarator.value);
            }
            for (Expression& e : s.expressions) expression(e);
            statements(s.body);
            statements(s.otherwise);
        }
    }

    std::map<std::string, std::string, std::less<>> renamed_;
};

}  // namespace

void prefix_names(std::vector<Unit>& units) {
    Prefixer prefixer;
    for (const Unit& unit : units)
        for (const Item& item : unit.items) prefixer.declare(item);
    for (Unit& unit : units) prefixer.rename(unit);
}

}  // namespace dermis::shading
