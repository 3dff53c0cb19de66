/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The twist that rigid joins pass from wire to wire. Private to this room. */
#ifndef SW_SYSTEM_JOIN_TWIST_H
#define SW_SYSTEM_JOIN_TWIST_H

#include "system/hub.h"

/* Before bodies are evaluated or followed at x: computes the twist of all spans of wires with such
 * joins (twist_now), and places the joins' directors. */
void sw_joins_twist(sw_system *system, const double *x);

/* Adds the forces of the twist on a hub's arms, and keeps the slopes of its spans there. C: of
 * sw_hub_compliance. */
void sw_join_twist_eval(sw_system *system, const sw_join_hub *hub, const sw_hub_arm *arms,
                        const double C[9]);

/* Returns by how much the twist at the state turns the hub on from where its arms alone hold it
 * [rad]. */
sw_vec sw_join_hub_give(const sw_system *system, const sw_join_hub *hub, const sw_hub_arm *arms);

/* Number of a body's span among those that end at joins, or SIZE_MAX. */
size_t sw_joins_span(const sw_system *system, const sw_body *body, size_t span);

/* Adds a span's slope at the joins' arms to out, in the bridges' matrix. */
void sw_join_twist_put(const sw_system *system, size_t number, double *out);
/* Returns this slope times x. */
double sw_join_twist_dot(const sw_system *system, size_t number, const double *x);

/* In the equations of all bridged spans: notes a span's row; adds what hubs give to the compliances
 * S (m x m). */
void sw_joins_row(const sw_system *system, const sw_body *body, size_t span, size_t row);
void sw_joins_add_give(const sw_system *system, double *S, size_t m);
/* Corrects the spans' added torques (twist_gain) for what hubs give. */
void sw_joins_gain(sw_system *system);

/* Adds the twist's part to the reaction of a held node of an arm. */
void sw_join_twist_react(const sw_system *system, sw_held_node *held);

#endif
