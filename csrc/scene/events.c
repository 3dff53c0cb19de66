/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of events: adds, merges repeats, counts dropped ones. */
#include "scene/events.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "scene/course.h"
#include "scene/parts.h"

/* The same event within this time is a repeat [s]; the time is longer where steps are. */
static const double REPEAT = 0.1;
static const double REPEAT_STEPS = 2.5; /* of the last step [-] */

void sw_events_clear(sw_events *e) {
  sw_free(e->list);
  *e = (sw_events){0};
}

static void copy_name(char *out, const char *name) {
  snprintf(out, SW_NAME_SIZE, "%s", name ? name : "");
}

/* Returns the latest event of this kind and object, or NULL. */
static sw_event *latest(sw_events *e, const char *kind, const char *object) {
  for (size_t i = e->count; i-- > 0;)
    if (strcmp(e->list[i].kind, kind) == 0 && strcmp(e->list[i].object, object) == 0)
      return &e->list[i];
  return NULL;
}

static sw_event *append(sw_events *e) {
  if (e->count >= SW_EVENTS_MOST || SW_GROW(e->list, e->capacity, e->count + 1) != SW_OK) {
    e->dropped++;
    return NULL;
  }
  return &e->list[e->count++];
}

sw_event *sw_events_go_on(sw_events *e, const char *kind, const char *object, double time) {
  sw_event *event = latest(e, kind, object);
  if (event) event->last = time;
  return event;
}

/* Ends a text that is too long with three dots, after a whole letter of UTF-8. size: [B]. */
static void mark_cut(char *text, size_t size) {
  size_t end = size - sizeof "...";
  while (end > 0 && ((unsigned char)text[end] & 0xC0) == 0x80) end--;
  memcpy(text + end, "...", sizeof "...");
}

/* Books an event at this time [s]; see sw_scene_tell. */
__attribute__((format(printf, 7, 0))) static void book(sw_scene *s, double time, const char *kind,
                                                       const char *object, double arc, double value,
                                                       const char *format, va_list arguments) {
  sw_course *c = sw_scene_course(s);
  char name[SW_NAME_SIZE], word[SW_NAME_SIZE];
  copy_name(name, object);
  copy_name(word, kind);
  sw_event *e = latest(sw_scene_events_of(s), word, name);
  const double soon = fmax(REPEAT, c->has_stepper ? REPEAT_STEPS * c->stepper.last_h : 0.0);
  if (e && (time - e->last > soon && sw_scene_events_of(s)->count < SW_EVENTS_MOST)) e = NULL;
  const int repeat = e != NULL;
  if (!e && !(e = append(sw_scene_events_of(s)))) return;
  if (!repeat) {
    *e = (sw_event){.first = time, .value = NAN, .s = NAN};
    memcpy(e->kind, word, sizeof e->kind);
    memcpy(e->object, name, sizeof e->object);
  }
  e->count++;
  e->last = time;
  if (repeat && !(fabs(value) > fabs(e->value))) return;
  e->time = time, e->s = arc, e->value = value;
  const int length = vsnprintf(e->text, sizeof e->text, format, arguments);
  if (length >= (int)sizeof e->text) mark_cut(e->text, sizeof e->text);
}

void sw_scene_tell(sw_scene *s, const char *kind, const char *object, double arc, double value,
                   const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  book(s, sw_scene_time(s), kind, object, arc, value, format, arguments);
  va_end(arguments);
}

__attribute__((format(printf, 7, 8))) static void tell_at(sw_scene *s, double time,
                                                          const char *kind, const char *object,
                                                          double arc, double value,
                                                          const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  book(s, time, kind, object, arc, value, format, arguments);
  va_end(arguments);
}

size_t sw_scene_events_dropped(const sw_scene *s) { return sw_scene_events_of(s)->dropped; }
const sw_event *sw_scene_event(const sw_scene *s, size_t k) {
  return k < sw_scene_events_of(s)->count ? &sw_scene_events_of(s)->list[k] : NULL;
}

sw_status sw_scene_book_event(sw_scene *s, const char *kind, const char *object, double arc,
                              double value, double time, const char *text, sw_error *err) {
  const double now = sw_scene_time(s);
  if (!kind[0]) return sw_fail(err, SW_EINVAL, "scene:tell: kind is empty; it is a word");
  if (time > now)
    return sw_fail(err, SW_EINVAL,
                   "scene:tell: time = %g s lies ahead; it must be at most the scene's %g s", time,
                   now);
  sw_events *all = sw_scene_events_of(s);
  const sw_event *before = latest(all, kind, object);
  const size_t count = before && before->last == time ? before->count : 0;
  tell_at(s, isnan(time) ? now : time, kind, object, arc, value, "%s", text);
  sw_event *e = count ? latest(all, kind, object) : NULL;
  if (e) e->count = count; /* told again for its own time: it has a larger value now */
  return SW_OK;
}

void sw_tape_event(sw_tape *t, sw_event *x) {
  SW_TAPE_STRUCT(t, sw_event, 400);
  sw_tape_name(t, x->kind), sw_tape_name(t, x->object);
  sw_tape_raw(t, x->text, sizeof x->text);
  if (sw_tape_reads(t)) x->text[sizeof x->text - 1] = 0;
  sw_tape_double(t, &x->time), sw_tape_double(t, &x->first), sw_tape_double(t, &x->last);
  sw_tape_double(t, &x->s), sw_tape_double(t, &x->value);
  sw_tape_size(t, &x->count);
}
