/* States that are reached: counted, looked up in batches, stored, judged. */
#ifndef REBSYNC_STORING_H
#define REBSYNC_STORING_H

#include "frontier.h"

/* --- what is wrong */

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
static void note(struct search *s, struct event found)
{
    const struct event *known = (struct event *)s->events.data;
    for (size_t i = 0; i < s->events.count; i++)
        if (known[i].kind == found.kind && known[i].pc == found.pc && known[i].rebec == found.rebec)
            return;
    *(struct event *)added(s->escape, &s->events, sizeof found) = found;
    s->violated |= s->first && is_fault(s, &found);
}

static struct valuation value_of(struct search *s, int32_t number)
{
    struct valuation found = kernel_evaluate(s->kernel, number);
    expect(s, found.answer);
    return found;
}

/* The extremes of a measure with the state observed last. */
static void measure(struct search *s, int32_t number, int64_t state)
{
    struct measured *m = s->measured + number;
    struct valuation found = value_of(s, s->model->predicates + number);
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
static void judge_invariant(struct search *s, int32_t predicate, int64_t state)
{
    struct valuation found = value_of(s, predicate);
    if (!found.defined)
        note(s, (struct event){found.kind, found.pc, -1, state, -1});
    else if (!found.value)
        note(s, (struct event){PREDICATE, predicate, 0, state, -1});
}

/* What predicates and measures say of a state. */
static void judge_values(struct search *s, uint64_t state, const uint64_t *words)
{
    if (s->invariant_count || s->model->measures) {
        unpack(s, words, s->unpacked);
        kernel_observe(s->kernel, s->unpacked);
    }
    for (uint32_t i = 0; i < s->invariant_count; i++)
        judge_invariant(s, s->invariants[i], (int64_t)state);
    for (int32_t i = 0; i < s->model->measures; i++)
        measure(s, i, (int64_t)state);
}

static void judge(struct search *s, uint64_t state, const uint64_t *words, int deadlock)
{
    if (!s->judged_later)
        judge_values(s, state, words);
    if (deadlock)
        note(s, (struct event){DEADLOCK, 0, 0, (int64_t)state, -1});
}

/* --- batches */

/* Keeps a state, its step and its time. */
static void keep(struct search *s, const struct pending *p, const uint64_t *words)
{
    size_t size = s->words * sizeof *words;
    memcpy((char *)room_for(s->escape, &s->states, (s->count + 1) * size, 1) + s->count * size, words, size);
    *(uint32_t *)added(s->escape, &s->parents, sizeof(uint32_t)) = p->parent;
    if (s->until != NEVER)
        *(int64_t *)added(s->escape, &s->times, sizeof(int64_t)) = p->time;
}

/* The same with fingerprints: the state is kept as long as it waits. */
static void keep_waiting(struct search *s, const struct pending *p, const uint64_t *words)
{
    struct arrival arrival = {s->beginning ? 0 : p->parent, p->code};
    write_arrival(s->escape, &s->trail, arrival);
    push_state(s, words, p->time);
}

/* Puts a state into the set of those seen; 0 when it is there already. */
static int insert(struct search *s, const struct pending *p, const uint64_t *words)
{
    if (s->compact)
        return insert_print(s->escape, &s->prints, p->hash);
    uint64_t at = find(s, words, p->hash);
    if (s->table[at])
        return 0;
    s->table[at] = tag_of(s, p->hash) | (uint32_t)(s->count + 1);
    return 1;
}

static void settle(struct search *s, const struct pending *p, const uint64_t *words)
{
    if (p->event >= 0) {
        note(s, s->failed[p->event]);
        return;
    }
    room_for_state(s);
    if (!insert(s, p, words))
        return;
    if (s->compact)
        keep_waiting(s, p, words);
    else
        keep(s, p, words);
    judge(s, s->count++, words, p->deadlock);
}

/* Looks up and stores what has gathered, in its order. The first violation ends the search before the
 * state whose step it is: of later ones there are steps that are not counted. */
static void flush(struct search *s)
{
    uint32_t count = s->pending;
    s->pending = 0;
    for (uint32_t i = 0; i < count; i++) {
        settle(s, s->batch + i, s->batch_words + (size_t)i * s->words);
        if (!s->violated)
            continue;
        if (!s->beginning) {
            s->transitions -= count - i - 1;
            s->expanded -= (uint32_t)s->expanded - s->batch[i].parent;
        }
        longjmp(s->escape->to, VIOLATED);
    }
}

/* The next state to be expanded, packed; there is one. */
static const uint64_t *front(struct search *s)
{
    struct states *head = &s->frontier.head;
    if (!s->compact)
        return words_of(s, s->expanded);
    if (head->expanded == head->count) {
        flush(s);
        refill(s);
    }
    return packed_in(s, head, head->expanded);
}

/* Makes room in the batch for a step, and in words for its state. */
static inline void room_in_batch(struct search *s, uint64_t code)
{
    if (code > UINT32_MAX)
        give_up(s->escape);
    if (s->pending == BATCH)
        flush(s);
    if (s->wide) {
        flush(s);
        repack(s);
    }
}

/* Puts a step into the batch; the state whose step it is comes behind those expanded. */
static inline struct pending *gather(struct search *s, uint64_t code)
{
    struct pending *p = s->batch + s->pending++;
    p->parent = s->beginning ? (uint32_t)code : (uint32_t)s->expanded;
    p->code = (uint32_t)code;
    p->event = -1;
    s->transitions += !s->beginning;
    return p;
}

static void store_state(struct search *s, const struct transition *step, int64_t time)
{
    room_in_batch(s, step->code);
    uint64_t *words = s->batch_words + (size_t)s->pending * s->words;
    struct pending *p = gather(s, step->code);
    pack(s, step->state, words);
    p->time = time;
    p->deadlock = step->deadlock;
    if (s->compact) {
        p->hash = kernel_fingerprint(s->kernel, step->state);
        __builtin_prefetch(place_of_print(&s->prints, p->hash), 1);
    } else {
        p->hash = hash_words(s, words);
        if (s->slots)
            __builtin_prefetch(s->table + slot_of(s, p->hash), 1);
    }
}

static void store_failure(struct search *s, const struct transition *step)
{
    int64_t state = s->beginning ? -1 : (int64_t)s->expanded, code = (int64_t)step->code;
    room_in_batch(s, step->code);
    struct pending *p = gather(s, step->code);
    p->event = (int32_t)(p - s->batch);
    s->failed[p->event] = (struct event){step->kind, step->pc, step->rebec, state, code};
}

/* When the state that is expanded was reached. */
static int64_t time_before(struct search *s)
{
    const struct states *head = &s->frontier.head;
    if (s->beginning)
        return 0;
    return s->compact ? ((int64_t *)head->times.data)[head->expanded]
                      : ((int64_t *)s->times.data)[s->expanded];
}

/* Takes in a step that the kernel has made. */
static void store(void *search, const struct transition *step)
{
    struct search *s = search;
    int64_t time = step->time;
    if (!step->state) {
        store_failure(s, step);
        return;
    }
    if (s->until != NEVER) {
        time += time_before(s);
        if (time > s->until) {
            s->dropped++;
            return;
        }
    }
    store_state(s, step, time);
}

#endif
