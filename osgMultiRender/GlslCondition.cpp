// SPDX-License-Identifier: MIT
#include <osgMultiRender/GlslCondition.h>

#include <charconv>
#include <string>

namespace osgMultiRender
{

namespace
{

enum class Operator
{
    Bracket,
    Plus,
    Minus,
    Not,
    Invert,
    Multiply,
    Divide,
    Modulo,
    Add,
    Subtract,
    ShiftLeft,
    ShiftRight,
    Less,
    Greater,
    LessEqual,
    GreaterEqual,
    Equal,
    NotEqual,
    BitAnd,
    BitXor,
    BitOr,
    And,
    Or
};

struct Spelling
{
    std::string_view word;
    Operator what;
    int precedence; ///< Higher binds stronger.
};

constexpr Spelling BinaryOperators[] = {
    {"*", Operator::Multiply, 10},     {"/", Operator::Divide, 10},
    {"%", Operator::Modulo, 10},       {"+", Operator::Add, 9},
    {"-", Operator::Subtract, 9},      {"<<", Operator::ShiftLeft, 8},
    {">>", Operator::ShiftRight, 8},   {"<", Operator::Less, 7},
    {">", Operator::Greater, 7},       {"<=", Operator::LessEqual, 7},
    {">=", Operator::GreaterEqual, 7}, {"==", Operator::Equal, 6},
    {"!=", Operator::NotEqual, 6},     {"&", Operator::BitAnd, 5},
    {"^", Operator::BitXor, 4},        {"|", Operator::BitOr, 3},
    {"&&", Operator::And, 2},          {"||", Operator::Or, 1}};

constexpr Spelling UnaryOperators[] = {{"+", Operator::Plus, 11},
                                       {"-", Operator::Minus, 11},
                                       {"!", Operator::Not, 11},
                                       {"~", Operator::Invert, 11}};

template <std::size_t N> const Spelling* find(const Spelling (&spellings)[N], std::string_view word)
{
    for (const Spelling& spelling : spellings)
    {
        if (spelling.word == word)
        {
            return &spelling;
        }
    }
    return nullptr;
}

GlslValue parseNumber(std::string_view word)
{
    while (!word.empty() && (word.back() == 'u' || word.back() == 'U'))
    {
        word.remove_suffix(1);
    }
    int base = 10;
    if (word.size() > 2 && word[0] == '0' && (word[1] == 'x' || word[1] == 'X'))
    {
        base = 16;
        word.remove_prefix(2);
    }
    else if (word.size() > 1 && word[0] == '0')
    {
        base = 8;
    }
    GlslValue result;
    const char* end = word.data() + word.size();
    const auto parsed = std::from_chars(word.data(), end, result.value, base);
    result.known = !word.empty() && word[0] != '-' && parsed.ec == std::errc() && parsed.ptr == end;
    return result.known ? result : GlslValue{};
}

// Unsigned arithmetic: it wraps where the signed one is undefined.
using Unsigned = unsigned long long;

GlslValue applyUnary(Operator what, GlslValue a)
{
    switch (what)
    {
    case Operator::Minus:
        a.value = static_cast<long long>(0 - static_cast<Unsigned>(a.value));
        break;
    case Operator::Not:
        a.value = !a.value;
        break;
    case Operator::Invert:
        a.value = ~a.value;
        break;
    default:
        break;
    }
    return a;
}

GlslValue applyLogical(Operator what, const GlslValue& a, const GlslValue& b)
{
    const bool decisive = what == Operator::Or;
    for (const GlslValue& side : {a, b})
    {
        if (side.known && (side.value != 0) == decisive)
        {
            return {true, decisive};
        }
    }
    return {a.known && b.known, !decisive};
}

GlslValue applyBinary(Operator what, const GlslValue& a, const GlslValue& b)
{
    if (what == Operator::And || what == Operator::Or)
    {
        return applyLogical(what, a, b);
    }
    const bool divides = what == Operator::Divide || what == Operator::Modulo;
    const bool shifts = what == Operator::ShiftLeft || what == Operator::ShiftRight;
    // -1 as divisor: the quotient of the smallest number overflows.
    if (!a.known || !b.known || (divides && (b.value == 0 || b.value == -1)) ||
        (shifts && (b.value < 0 || b.value > 63)))
    {
        return {};
    }
    const Unsigned x = static_cast<Unsigned>(a.value), y = static_cast<Unsigned>(b.value);
    const auto wrapped = [](Unsigned value) {
        return GlslValue{true, static_cast<long long>(value)};
    };
    switch (what)
    {
    case Operator::Multiply:
        return wrapped(x * y);
    case Operator::Divide:
        return {true, a.value / b.value};
    case Operator::Modulo:
        return {true, a.value % b.value};
    case Operator::Add:
        return wrapped(x + y);
    case Operator::Subtract:
        return wrapped(x - y);
    case Operator::ShiftLeft:
        return wrapped(x << y);
    case Operator::ShiftRight:
        return {true, a.value >> b.value};
    case Operator::Less:
        return {true, a.value < b.value};
    case Operator::Greater:
        return {true, a.value > b.value};
    case Operator::LessEqual:
        return {true, a.value <= b.value};
    case Operator::GreaterEqual:
        return {true, a.value >= b.value};
    case Operator::Equal:
        return {true, a.value == b.value};
    case Operator::NotEqual:
        return {true, a.value != b.value};
    case Operator::BitAnd:
        return wrapped(x & y);
    case Operator::BitXor:
        return wrapped(x ^ y);
    case Operator::BitOr:
        return wrapped(x | y);
    default:
        return {};
    }
}

/// Two stacks, as E. W. Dijkstra's shunting yard.
class Evaluator
{
public:
    GlslValue run(const std::vector<std::string_view>& words)
    {
        for (std::string_view word : words)
        {
            if (!(_operandNext ? takeOperand(word) : takeOperator(word)))
            {
                return {};
            }
        }
        if (_operandNext || !reduce(0) || !_operators.empty() || _values.size() != 1)
        {
            return {};
        }
        return _values.back();
    }

private:
    struct Entry
    {
        Operator what;
        int precedence;
    };

    bool takeOperand(std::string_view word)
    {
        if (word == "(")
        {
            _operators.push_back({Operator::Bracket, 0});
        }
        else if (const Spelling* unary = find(UnaryOperators, word))
        {
            _operators.push_back({unary->what, unary->precedence});
        }
        else
        {
            _values.push_back(parseNumber(word));
            _operandNext = false;
        }
        return true;
    }

    bool takeOperator(std::string_view word)
    {
        if (word == ")")
        {
            if (!reduce(1) || _operators.empty())
            {
                return false;
            }
            _operators.pop_back();
            return true;
        }
        const Spelling* binary = find(BinaryOperators, word);
        if (!binary || !reduce(binary->precedence))
        {
            return false;
        }
        _operators.push_back({binary->what, binary->precedence});
        _operandNext = true;
        return true;
    }

    /// Applies what binds at least as strongly as `precedence`, up to an open bracket.
    bool reduce(int precedence)
    {
        while (!_operators.empty() && _operators.back().what != Operator::Bracket &&
               _operators.back().precedence >= precedence)
        {
            const Entry entry = _operators.back();
            _operators.pop_back();
            const std::size_t needed = entry.precedence == 11 ? 1 : 2;
            if (_values.size() < needed)
            {
                return false;
            }
            const GlslValue last = _values.back();
            _values.pop_back();
            if (needed == 1)
            {
                _values.push_back(applyUnary(entry.what, last));
                continue;
            }
            _values.back() = applyBinary(entry.what, _values.back(), last);
        }
        return true;
    }

    bool _operandNext = true;
    std::vector<GlslValue> _values;
    std::vector<Entry> _operators;
};

} // namespace

GlslValue evaluate(const std::vector<std::string_view>& words)
{
    return Evaluator().run(words);
}

} // namespace osgMultiRender
