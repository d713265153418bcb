// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdio>
#include <cstdlib>
#include <type_traits>
#include <utility>

/// What mutation.py puts in the place of operators and numbers of a copy of the sources: all mutants in one build, one of them switched on
/// by the environment variable POLYTOPE_MUTANT. Included before anything else.
///
/// `a * b` becomes `a * mutation::Binary<7, Times, Over>{} * b`: the object between has the operator's own precedence and stands where
/// the operator stood, so the expression keeps its meaning whatever surrounds it.
namespace mutation {

enum Operator { Plus, Minus, Times, Over, Less, LessEqual, Greater, GreaterEqual, Equal, Unequal };

constexpr int most = 20000;

inline bool reached[most]; ///< which mutants a run has come past, whether switched on or not

/// Number of the mutant that is switched on, 0: none. With POLYTOPE_MUTANTS_REACHED=FILE the numbers of those reached are written at the end.
class Choice {
public:
	Choice() : number(numberOf(std::getenv("POLYTOPE_MUTANT"))) { }
	~Choice()
	{
		const char* path = std::getenv("POLYTOPE_MUTANTS_REACHED");
		if (!path) return;
		if (std::FILE* file = std::fopen(path, "w")) {
			for (int i = 0; i < most; ++i)
				if (reached[i]) std::fprintf(file, "%d\n", i);
			std::fclose(file);
		}
	}
	const int number;

private:
	static int numberOf(const char* text) { return text ? std::atoi(text) : 0; }
};

inline const Choice choice;

[[gnu::always_inline]] inline bool on(int mutant)
{
	reached[mutant] = true;
	return choice.number == mutant;
}

template <Operator op, class A, class B> [[gnu::always_inline]] inline auto apply(A&& a, B&& b)
{
	if constexpr (op == Plus) return a + b;
	else if constexpr (op == Minus) return a - b;
	else if constexpr (op == Times) return a * b;
	else if constexpr (op == Over) return a / b;
	else if constexpr (op == Less) return a < b;
	else if constexpr (op == LessEqual) return a <= b;
	else if constexpr (op == Greater) return a > b;
	else if constexpr (op == GreaterEqual) return a >= b;
	else if constexpr (op == Equal) return a == b;
	else return a != b;
}

/// The type of the value of an expression of Eigen, which refers to its operands; for all else, the type itself.
template <class E, class = void> struct ValueOf {
	using Type = E;
};
template <class E> struct ValueOf<E, std::void_t<typename E::PlainObject>> {
	using Type = typename E::PlainObject;
};

template <int mutant, Operator from, Operator to> struct Binary { };

template <class A, int mutant, Operator from, Operator to> struct Left {
	A&& a;

	template <class B> [[gnu::always_inline]] auto with(B&& b) const
	{
		using Value = typename ValueOf<decltype(apply<from>(std::forward<A>(a), std::forward<B>(b)))>::Type;
		if (on(mutant)) return Value(apply<to>(std::forward<A>(a), std::forward<B>(b)));
		return Value(apply<from>(std::forward<A>(a), std::forward<B>(b)));
	}
};

#define POLYTOPE_MUTATED(op)                                                                                                               \
	template <class A, int mutant, Operator from, Operator to>                                                                         \
	[[gnu::always_inline]] inline Left<A, mutant, from, to> operator op(A && a, Binary<mutant, from, to>)                              \
	{                                                                                                                                  \
		return { std::forward<A>(a) };                                                                                             \
	}                                                                                                                                  \
	template <class A, int mutant, Operator from, Operator to, class B>                                                                \
	[[gnu::always_inline]] inline auto operator op(const Left<A, mutant, from, to>& left, B&& b)                                       \
	{                                                                                                                                  \
		return left.with(std::forward<B>(b));                                                                                      \
	}

POLYTOPE_MUTATED(+)
POLYTOPE_MUTATED(*)
POLYTOPE_MUTATED(<)
POLYTOPE_MUTATED(==)
#undef POLYTOPE_MUTATED

/// `-x` becomes `Sign<7>{}->*x`, which binds tighter than the operators beside a sign.
template <int mutant> struct Sign { };
template <int mutant, class B> [[gnu::always_inline]] inline auto operator->*(Sign<mutant>, B&& b)
{
	using Value = typename ValueOf<decltype(-b)>::Type;
	if (on(mutant)) return Value(b);
	return Value(-b);
}

/// `x += y` becomes `x += Increment<7>{} %= y`: assignments are read from the right.
template <int mutant> struct Increment {
	template <class B> [[gnu::always_inline]] auto operator%=(B&& b) const
	{
		using Given = typename ValueOf<std::decay_t<B>>::Type;
		using Value = std::conditional_t<std::is_same_v<Given, bool>, int, Given>; // a bool would stay true
		if (on(mutant)) return Value(-b);
		return Value(b);
	}
};

template <int mutant, class T> [[gnu::always_inline]] inline T constant(T value, int change)
{
	return on(mutant) ? T(value + T(change)) : value;
}

} // namespace mutation
