// Key codes for ImGui::IsKeyPressed(). Up to Dear ImGui 1.86 these are the window library's (GLFW's); from
// 1.87 on Dear ImGui has its own.
#pragma once

#include <imgui.h>

#if IMGUI_VERSION_NUM < 18700
#include <GLFW/glfw3.h>
#endif

namespace skel::key {

#if IMGUI_VERSION_NUM < 18700
using Code = int;
#define SKEL_KEY(imgui_name, glfw_name) GLFW_KEY_##glfw_name
#else
using Code = ImGuiKey;
#define SKEL_KEY(imgui_name, glfw_name) ImGuiKey_##imgui_name
#endif

inline constexpr Code k0 = SKEL_KEY(0, 0), k1 = SKEL_KEY(1, 1), k2 = SKEL_KEY(2, 2), k3 = SKEL_KEY(3, 3),
                      k4 = SKEL_KEY(4, 4), k5 = SKEL_KEY(5, 5), k6 = SKEL_KEY(6, 6), k7 = SKEL_KEY(7, 7),
                      k8 = SKEL_KEY(8, 8);
inline constexpr Code kA = SKEL_KEY(A, A), kB = SKEL_KEY(B, B), kC = SKEL_KEY(C, C), kD = SKEL_KEY(D, D),
                      kE = SKEL_KEY(E, E), kF = SKEL_KEY(F, F), kG = SKEL_KEY(G, G), kH = SKEL_KEY(H, H),
                      kJ = SKEL_KEY(J, J), kK = SKEL_KEY(K, K), kL = SKEL_KEY(L, L), kM = SKEL_KEY(M, M),
                      kN = SKEL_KEY(N, N), kO = SKEL_KEY(O, O), kP = SKEL_KEY(P, P), kQ = SKEL_KEY(Q, Q),
                      kR = SKEL_KEY(R, R), kS = SKEL_KEY(S, S), kT = SKEL_KEY(T, T), kU = SKEL_KEY(U, U),
                      kV = SKEL_KEY(V, V), kW = SKEL_KEY(W, W), kX = SKEL_KEY(X, X), kY = SKEL_KEY(Y, Y),
                      kZ = SKEL_KEY(Z, Z);
inline constexpr Code kLeft = SKEL_KEY(LeftArrow, LEFT), kRight = SKEL_KEY(RightArrow, RIGHT),
                      kUp = SKEL_KEY(UpArrow, UP), kDown = SKEL_KEY(DownArrow, DOWN),
                      kPageUp = SKEL_KEY(PageUp, PAGE_UP), kPageDown = SKEL_KEY(PageDown, PAGE_DOWN);
inline constexpr Code kEnter = SKEL_KEY(Enter, ENTER), kSpace = SKEL_KEY(Space, SPACE),
                      kEscape = SKEL_KEY(Escape, ESCAPE), kTab = SKEL_KEY(Tab, TAB),
                      kDelete = SKEL_KEY(Delete, DELETE), kBackspace = SKEL_KEY(Backspace, BACKSPACE);
inline constexpr Code kPlus = SKEL_KEY(Equal, EQUAL), kMinus = SKEL_KEY(Minus, MINUS),
                      kLeftBracket = SKEL_KEY(LeftBracket, LEFT_BRACKET),
                      kRightBracket = SKEL_KEY(RightBracket, RIGHT_BRACKET), kSlash = SKEL_KEY(Slash, SLASH),
                      kF1 = SKEL_KEY(F1, F1);

#undef SKEL_KEY

}  // namespace skel::key
