/* What is wrong in states and steps, and what measures are in them. */
#ifndef REBSYNC_JUDGING_H
#define REBSYNC_JUDGING_H

#include "search.h"

/* Whether an event is a violation. */
static int is_fault(const struct search *s, const struct event *found)
{
    if (found->kind == DEADLOCK)
        return s->deadlock_is_fault;
    if (found->kind != PREDICATE)
        return 1;
    for (uint32_t i = 0; i < s->fault_count; i++)
        if (s->faults[i] == found->pc)
            return 1;
    return 0;
}

/* Notes an event unless its cause is known. */
static void note(struct judge *j, struct event found)
{
    const struct event *known = (struct event *)j->events.data;
    for (size_t i = 0; i < j->events.count; i++)
        if (known[i].kind == found.kind && known[i].pc == found.pc && known[i].rebec == found.rebec)
            return;
    *(struct event *)added(j->escape, &j->events, sizeof found) = found;
    j->violated |= j->search->first && is_fault(j->search, &found);
}

static void note_deadlock(struct judge *j, int64_t state)
{
    note(j, (struct event){DEADLOCK, 0, 0, state, -1});
}

static struct valuation value_of(struct judge *j, int32_t number)
{
    struct valuation found = kernel_evaluate(j->kernel, number);
    expect(j->escape, found.answer);
    return found;
}

static void measure_nothing(struct judge *j)
{
    for (int32_t i = 0; i < j->search->model->measures; i++)
        j->measured[i] = (struct measured){0, -1, 0, -1, -1};
}

/* The extremes of a measure with the state observed last. */
static void measure(struct judge *j, int32_t number, int64_t state)
{
    struct measured *m = j->measured + number;
    struct valuation found = value_of(j, j->search->model->predicates + number);
    if (!found.defined) {
        m->undefined = m->undefined < 0 ? state : m->undefined;
        return;
    }
    if (m->least_state < 0 || found.value < m->least) {
        m->least = found.value;
        m->least_state = state;
    }
    if (m->greatest_state < 0 || found.value > m->greatest) {
        m->greatest = found.value;
        m->greatest_state = state;
    }
}

/* A predicate that does not hold, or has no value, in the state observed last. */
static void judge_invariant(struct judge *j, int32_t predicate, int64_t state)
{
    struct valuation found = value_of(j, predicate);
    if (!found.defined)
        note(j, (struct event){found.kind, found.pc, -1, state, -1});
    else if (!found.value)
        note(j, (struct event){PREDICATE, predicate, 0, state, -1});
}

/* Whether anything is asked about states as such. */
static int is_asked(const struct search *s)
{
    return s->invariant_count || s->model->measures;
}

/* Judges a state, in the numbers of the judge's kernel, under the number that it is noted by. */
static void judge(struct judge *j, const uint32_t *ids, int64_t state)
{
    const struct search *s = j->search;
    kernel_observe(j->kernel, ids);
    for (uint32_t i = 0; i < s->invariant_count; i++)
        judge_invariant(j, s->invariants[i], state);
    for (int32_t i = 0; i < s->model->measures; i++)
        measure(j, i, state);
}

#endif
