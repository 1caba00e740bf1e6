/** Parts of the runs page that are loaded when they are wanted, so that the first page is light. */
import { lazy } from 'react';

export const BulkBar = lazy(() => import('./bulk-bar').then((part) => ({ default: part.BulkBar })));
export const FilterFields = lazy(() => import('./filter-fields').then((part) => ({ default: part.FilterFields })));
export const MetricPicker = lazy(() => import('./metric-picker').then((part) => ({ default: part.MetricPicker })));
export const SortField = lazy(() => import('./sort-field').then((part) => ({ default: part.SortField })));
